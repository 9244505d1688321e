#include <signal.h>

#include <algorithm>

#include "apps/run_program.h"
#include "support/catch.h"
#include "support/solids.h"
#include "support/variants.h"

using namespace stackabilization;
using namespace stackabilization::apps;
using nlohmann::json;

namespace {

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

TEST_CASE("names that are not UTF-8 are refused where they are read, by every command, and UTF-8 is kept") {
  const TemporaryFolder folder;
  const std::string stairs = bytes_of(folder.model("stairs.obj", solids::stair_plate({})));
  const auto named = [&](const std::string& name) {
    return "g " + name + "\n" + stairs.substr(0, stairs.find("g ")) + stairs.substr(stairs.find("f "));
  };
  const std::string latin = folder.file("latin.obj", named("caf\xe9")),
                    good = folder.file("good.obj", named("caf\xc3\xa9"));
  const std::size_t triangles = solids::stair_plate({}).triangle_part.size();
  std::string labels;
  for (std::size_t t = 0; t < triangles; ++t) labels += "caf\xe9\n";
  const std::string label_file = folder.file("labels.txt", labels);
  const std::string part_name = "caf\xc3\xa9";
  Arguments improve = {"improve", "", "--target", "0.6", "-o", folder / "out"};
  std::vector<Arguments> all = every_command("");
  all.push_back({"suggest", ""});
  all.push_back(improve);
  for (Arguments arguments : all) {
    arguments[1] = latin;
    check_refused(folder, joined(arguments, {"--json", folder / "out.json"}), 3,
                  "latin.obj:1: expected a name in UTF-8");
    arguments[1] = good;
    check_refused(folder, joined(arguments, {"--labels", label_file}), 3,
                  "labels.txt:1: expected names in UTF-8");
    arguments[1] = folder / "caf\xe9.obj";
    check_refused(folder, arguments, 2, "argument 2 expects UTF-8, found");
  }
  CHECK(run_program({"inspect", good, "--json", "-"}).json()["part_names"] == json({part_name}));
  CHECK(run_program({"deform", good, "--segmentation", "given", "--edit", part_name + " scale 0.9", "--json",
                     "-", "--save", folder / (part_name + ".json")})
            .json()["edits"]
            .size() == 1);
  CHECK(run_program({"inspect", folder / (part_name + ".json")}).status == 3);
  CHECK(run_program({"structure", folder / (part_name + ".json"), "--json", "-"}).json()["model"] ==
        folder / (part_name + ".json"));
  check_refused(folder, {"structure", good, "--seeds", folder.file("seeds.txt", "caf\xe9 0\n")}, 3,
                "seeds.txt:1: expected a name in UTF-8");
}

TEST_CASE("an interrupted run ends with 130, a terminated one with 143, and both leave nothing behind") {
  for (const auto& [signal, status] : {std::pair(SIGINT, 130), std::pair(SIGTERM, 143)}) {
    const TemporaryFolder folder;
    const std::string model = folder.model("soup.obj", solids::triangle_soup({3, 3000, 0.2, 1, 0}));
    // In the midst of its work, which takes many minutes.
    const Outcome outcome = run_and_signal(
        {"map", model, "--step-degrees", "0.1", "-o", folder / "map.csv", "--json", folder / "map.json"},
        signal, [](pid_t process) { return processor_seconds(process) >= 0.5; });
    CHECK(outcome.status == status);
    CHECK(outcome.out.empty());
    CHECK(outcome.err == "stackabilize: interrupted\n");
    CHECK(folder.names() == std::vector<std::string>{"soup.obj"});
  }
}
