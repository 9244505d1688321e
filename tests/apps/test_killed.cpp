#include <signal.h>

#include <chrono>
#include <filesystem>
#include <map>

#include "apps/run_program.h"
#include "stackabilization/io/read.h"
#include "stackabilization/io/write_file.h"
#include "support/catch.h"
#include "support/solids.h"

using namespace stackabilization;
using namespace stackabilization::apps;
using nlohmann::json;

namespace {

/// Shares of the time that a whole run takes, after which others are killed.
constexpr double moments[] = {0.3, 0.7, 0.95};

/// Runs the program and kills it after so many seconds, if it still runs then.
void run_and_kill(const Arguments& arguments, double seconds) {
  const Outcome outcome =
      run_program(arguments, "", "timeout --foreground -s KILL " + std::to_string(seconds));
  INFO(outcome.status << outcome.err);
  // 124: it ended just before.
  CHECK((outcome.status == 137 || outcome.status == 124 || outcome.status <= 1));
}

/// Runs the program until it has written so many bytes of a file, and then the system kills it.
void run_and_kill_in_write(const Arguments& arguments, int blocks_of_512) {
  const Outcome outcome =
      run_program(arguments, "", "ulimit -c 0; ulimit -f " + std::to_string(blocks_of_512) + ";");
  INFO(outcome.status << outcome.err);
  CHECK(outcome.status == 128 + SIGXFSZ);
}

double seconds_of(const Arguments& arguments, int status) {
  const auto start = std::chrono::steady_clock::now();
  const Outcome outcome = run_program(arguments);
  INFO(outcome.err);
  REQUIRE(outcome.status == status);
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

/// A search in a model and the folders that runs of it fill. All of it is over in a few seconds.
struct SearchFolder : TemporaryFolder {
  explicit SearchFolder(Arguments the_task) : task(std::move(the_task)) {
    solids::FrustumShell coarse;
    coarse.segments = 16;
    cup = model("cup.obj", solids::frustum_shell(coarse));
  }

  Arguments into(const std::string& folder, const Arguments& further = {}) const {
    return joined(joined({"improve", cup, "--direction", "0", "0", "1", "-o", *this / folder}, task),
                  further);
  }

  Arguments task;
  std::string cup;
};

/// Can a file of a design that was found on the way be read to its end?
void check_readable(const std::string& name, const std::string& bytes) {
  const TemporaryFolder folder;
  if (name.ends_with(".json"))
    CHECK(json::accept(bytes));
  else if (name.ends_with(".html"))
    CHECK(bytes.ends_with("</html>\n"));
  else
    CHECK(read_shape(folder.file(name, bytes)).triangle_count() > 0);
}

/// Every file is there as the whole run wrote it, or as `before`, or can be read, since it is of a design
/// that was found on the way; all others have temporary names. Summaries speak of what is there.
void check_whole(const std::map<std::string, std::string>& left,
                 const std::map<std::string, std::string>& whole,
                 const std::map<std::string, std::string>& before) {
  for (const auto& [name, bytes] : left) {
    INFO(name);
    if (target_of_temporary(name)) continue;
    const auto made = whole.find(name), old = before.find(name);
    if ((made == whole.end() || made->second != bytes) && (old == before.end() || old->second != bytes))
      check_readable(name, bytes);
  }
  if (!left.contains("index.html")) return;
  const json result = json::parse(left.at("result.json"));
  for (const json& solution : result.at("solutions")) {
    const std::string name = solution.at("name");
    CHECK(json::parse(left.at(name + ".json")) == solution);
    for (const char* ending : {".obj", ".3mf", ".stackabilize.json"}) CHECK(left.contains(name + ending));
  }
  if (left.at("index.html") == whole.at("index.html"))
    for (const auto& [name, bytes] : whole)
      CHECK((name == "stackabilize-files.json" || (left.contains(name) && left.at(name) == bytes)));
}

void check_resumed(const SearchFolder& folder, int status) {
  const double seconds = seconds_of(folder.into("whole"), status);
  const std::map<std::string, std::string> whole = contents(folder / "whole");
  REQUIRE(whole.size() > 4);
  // Left by another search before, whose state is none of this one.
  REQUIRE(run_program({"improve", folder.cup, "--target", "-1", "-o", folder / "killed"}).status == 0);
  const std::map<std::string, std::string> before = contents(folder / "killed");
  const Arguments resume = {"--resume", "--quiet"};
  for (const double share : moments) {
    INFO(share << " of " << seconds << " s");
    run_and_kill(folder.into("killed", resume), share * seconds);
    check_whole(contents(folder / "killed"), whole, before);
  }
  for (const int blocks : {1, 12}) {
    run_and_kill_in_write(folder.into("killed", resume), blocks);
    check_whole(contents(folder / "killed"), whole, before);
  }
  CHECK(run_program(folder.into("killed", resume)).status == status);
  CHECK(contents(folder / "killed") == whole);
}

}  // namespace

TEST_CASE("a refined improvement that is killed at any moment goes on to the same files") {
  check_resumed(SearchFolder({"--target", "0.51", "--solutions", "1", "--expansions", "6", "--no-pictures"}),
                0);
}

TEST_CASE("the first design is in the folder while the search goes on") {
  const SearchFolder folder({"--target", "0.51", "--solutions", "1", "--expansions", "6", "--no-pictures"});
  REQUIRE(run_program(folder.into("whole")).status == 0);
  run_and_signal(folder.into("killed"), SIGKILL,
                 [&](pid_t) { return std::filesystem::exists(folder / "killed/index.html"); });
  const std::map<std::string, std::string> left = contents(folder / "killed");
  check_whole(left, contents(folder / "whole"), {});
  const json result = json::parse(left.at("result.json"));
  CHECK(result.at("search").at("end") == "running");
  REQUIRE(result.at("solutions").size() == 1);
  CHECK(result.at("solutions")[0].at("good") == true);
  CHECK(left.at("index.html").find("had not ended") != std::string::npos);
  CHECK(left.contains("search-state.json"));
  CHECK(run_program(folder.into("killed", {"--resume"})).status == 0);
  CHECK(contents(folder / "killed") == contents(folder / "whole"));
}

TEST_CASE("a search that is killed at any moment goes on to the same files") {
  check_resumed(
      SearchFolder({"--target", "0.97", "--preset", "paper", "--expansions", "15", "--no-pictures"}), 1);
}

TEST_CASE("a step of a session that is killed leaves the project as it was or as it is to be") {
  const TemporaryFolder folder;
  const std::string table = folder.model("table.obj", solids::table({})), project = folder / "table.json";
  REQUIRE(run_program({"structure", table, "--save", project}).status == 0);
  const std::string before = bytes_of(project);
  const Arguments step = {"suggest", project, "--apply", "1"};
  const double seconds = seconds_of(step, 0);
  const std::string after = bytes_of(project);
  REQUIRE(after != before);
  for (const double share : {0.5, 0.8, 0.95, 1.05}) {
    CHECK(folder.file("table.json", before) == project);
    run_and_kill(step, share * seconds);
    const std::string left = bytes_of(project);
    CHECK((left == before || left == after));
  }
  CHECK(folder.file("table.json", before) == project);
  run_and_kill_in_write(step, 4);
  CHECK(bytes_of(project) == before);
  CHECK(folder.names().size() >= 3);  // with what was being written, here and perhaps before
  CHECK(folder.file("table.json", before) == project);
  CHECK(run_program(step).status == 0);
  CHECK(bytes_of(project) == after);
  CHECK(folder.names() == std::vector<std::string>{"table.json", "table.obj"});
}
