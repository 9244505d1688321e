#include <algorithm>

#include "apps/run_program.h"
#include "support/catch.h"
#include "support/solids.h"
#include "support/variants.h"

using namespace stackabilization;
using namespace stackabilization::apps;
using nlohmann::json;

namespace {

using Arguments = std::vector<std::string>;

Arguments joined(Arguments a, const Arguments& b) {
  a.insert(a.end(), b.begin(), b.end());
  return a;
}

/// One quick run of every command.
std::vector<Arguments> every_command(const std::string& model) {
  return {{"inspect", model},
          {"measure", model},
          {"measure", model, "--method", "rays", "--resolution", "32"},
          {"search", model, "--cone-degrees", "5"},
          {"map", model, "--step-degrees", "20"},
          {"stack", model, "-n", "4", "--twist-degrees", "auto", "--within", "100"},
          {"validate", model},
          {"structure", model},
          {"deform", model, "--edit", "shape scale 0.9"}};
}

}  // namespace

TEST_CASE("every command gives the same bytes for any number of threads, and with any seed") {
  const TemporaryFolder folder;
  const std::string model = folder.model("stairs.obj", solids::stair_plate({}));
  for (const Arguments& arguments : every_command(model)) {
    INFO(arguments[0]);
    const Outcome one = run_program(joined(arguments, {"--json", "-", "--no-timing", "--threads", "1"}));
    const Outcome two =
        run_program(joined(arguments, {"--json", "-", "--no-timing", "--threads", "2", "--seed", "7"}));
    CHECK(one.status == 0);
    CHECK(one.out == two.out);
    CHECK(one.out.find("\"seconds\"") == std::string::npos);
  }
}

TEST_CASE("every command prints JSON alone on standard output, and the same into a file") {
  const TemporaryFolder folder;
  const std::string model = folder.model("stairs.obj", solids::stair_plate({}));
  for (const Arguments& arguments : every_command(model)) {
    INFO(arguments[0]);
    const Outcome printed = run_program(joined(arguments, {"--json", "-", "--no-timing"}));
    const json document = printed.json();  // throws when anything else was printed
    CHECK(document["command"] == arguments[0]);
    CHECK(document["model"] == model);
    CHECK(document["findings"]["closed"] == true);
    CHECK(printed.err.empty());

    const std::string file = folder / (arguments[0] + ".json");
    const Outcome written = run_program(joined(arguments, {"--json", file, "--no-timing"}));
    CHECK(bytes_of(file) == printed.out);
    CHECK(!written.out.empty());
  }
}

TEST_CASE("every command reads standard input and says the essential in one line when quiet") {
  const TemporaryFolder folder;
  const std::string bytes = bytes_of(folder.model("stairs.obj", solids::stair_plate({})));
  for (const Arguments& arguments : every_command("-")) {
    INFO(arguments[0]);
    const Outcome outcome = run_program(joined(arguments, {"--quiet"}), bytes);
    CHECK(outcome.status == 0);
    CHECK(std::count(outcome.out.begin(), outcome.out.end(), '\n') == 1);
  }
  CHECK(run_program({"measure", "-", "--format", "obj", "--json", "-"}, bytes).json()["model"] == "-");
}

TEST_CASE("numbers come back from the text exactly as they were") {
  const TemporaryFolder folder;
  const std::string model = folder.model("cup.obj", solids::frustum_shell({}));
  const json result =
      run_program({"measure", model, "--direction", "0.3", "-0.2", "1", "--json", "-"}).json();
  CHECK(result["direction"] == json({0.3, -0.2, 1.0}));
  const Outcome quiet = run_program({"measure", model, "--direction", "0.3", "-0.2", "1", "--quiet"});
  CHECK(std::stod(quiet.out) == result["stackability"].get<double>());
}

TEST_CASE("part names that are not UTF-8 do not break the JSON") {
  const TemporaryFolder folder;
  const std::string model = folder.file(
      "latin.obj", "g caf\xe9\nv 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nf 1 3 2\nf 1 2 4\nf 2 3 4\nf 3 1 4\n");
  const Outcome outcome = run_program({"measure", model, "--json", "-"});
  CHECK(outcome.status == 0);
  CHECK(outcome.json().contains("f_max"));
}

TEST_CASE("an interrupted run ends with 130 and leaves nothing behind") {
  const TemporaryFolder folder;
  const Shape soup = solids::triangle_soup({3, 3000, 0.2, 1, 0});
  const std::string model = folder.model("soup.obj", soup);
  const Outcome outcome = run_program(
      {"map", model, "--step-degrees", "0.1", "-o", folder / "map.csv", "--json", folder / "map.json"}, "",
      "timeout --foreground --preserve-status -s INT 1");
  CHECK(outcome.status == 130);
  CHECK(outcome.out.empty());
  CHECK(outcome.err == "stackabilize: interrupted\n");
  CHECK(folder.names() == std::vector<std::string>{"soup.obj"});
}
