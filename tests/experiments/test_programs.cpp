#include <algorithm>
#include <map>
#include <nlohmann/json.hpp>
#include <sstream>

#include "apps/run_program.h"
#include "support/catch.h"
#include "support/solids.h"

using namespace stackabilization;
using apps::bytes_of;
using apps::Outcome;
using apps::TemporaryFolder;

namespace {

Outcome run(const std::string& program, std::vector<std::string> arguments) {
  arguments.insert(arguments.begin(), std::string(EXPERIMENTS_FOLDER) + "/" + program);
  return apps::run_program(arguments);
}

/// Does the program say one sentence about `what`, by its own name?
bool says(const Outcome& outcome, const std::string& program, const std::string& what) {
  return outcome.err.starts_with(program + ": ") && outcome.err.find(what) != std::string::npos &&
         std::count(outcome.err.begin(), outcome.err.end(), '\n') == 1;
}

const std::vector<std::string> with_models = {
    "deformation_models", "deformation_speed",   "design_quality", "direction_search",
    "envelope_accuracy",  "minimal_translation", "place_accuracy"};

/// Options with which a program is done in no time.
std::vector<std::string> quick(const std::string& program) {
  static const std::map<std::string, std::vector<std::string>> options = {
      {"deformation_models",
       {"--targets", "0.2", "--alphas", "0.8", "--expansions", "1", "--evaluations", "10", "--deformations",
        "cuboids,mixed"}},
      {"deformation_speed", {"--triangles", "12", "--edits", "5"}},
      {"design_quality", {"--gain", "0.1", "--effort", "0.02"}},
      {"direction_search", {"--largest", "100", "--seeds", "1"}},
      {"envelope_accuracy", {"--directions", "2", "--fine-directions", "0"}},
      {"minimal_translation", {"--directions", "2", "--slow-directions", "1"}},
      {"place_accuracy", {"--cells", "4"}},
      {"scaling",
       {"--largest-triangles", "2048", "--largest-parts", "8", "--directions", "2", "--finest-spacing",
        "0.32"}},
      {"study", {"cup", "--seeds", "2", "--edits", "4", "--expansions", "1"}}};
  return options.at(program);
}

std::vector<std::string> operator+(std::vector<std::string> a, const std::vector<std::string>& b) {
  a.insert(a.end(), b.begin(), b.end());
  return a;
}

}  // namespace

TEST_CASE("every experiment explains itself and its options") {
  for (const std::string& program :
       with_models + std::vector<std::string>{"scaling", "study", "relations_against_lists",
                                              "authors_designs", "run_all"}) {
    const Outcome outcome = run(program, {"--help"});
    CHECK(outcome.status == 0);
    CHECK(outcome.out.find("--output") != std::string::npos);
    CHECK(outcome.err.empty());
  }
}

TEST_CASE("wrong usage is refused with status 2") {
  for (const std::string& program : with_models) CHECK(run(program, {"--no-such-option"}).status == 2);
  CHECK(run("direction_search", {"--largest", "many"}).status == 2);
  CHECK(says(run("study", {"--edits", "1", "spoon"}), "study", "'spoon'"));
  CHECK(run("study", {"--edits", "1", "spoon"}).status == 2);
  CHECK(run("run_all", {}).status == 2);
}

TEST_CASE("a missing folder of the authors' data is refused with status 3 and one sentence") {
  const TemporaryFolder folder;
  for (const std::string& program : with_models + std::vector<std::string>{"study"}) {
    const Outcome outcome = run(program, {"--paper-data", folder / "nowhere"});
    CHECK(outcome.status == 3);
    CHECK(says(outcome, program, folder / "nowhere"));
  }
  const Outcome all = run("run_all", {"-o", folder / "results", "--paper-data", folder / "nowhere"});
  CHECK(all.status == 3);
  CHECK(says(all, "run_all", folder / "nowhere"));
}

TEST_CASE("a results folder that cannot be made is refused with status 2 and one sentence") {
  const TemporaryFolder folder;
  const std::string place = folder.file("file", "no folder") + "/results";
  for (const std::string& program : with_models + std::vector<std::string>{"scaling", "study", "run_all"}) {
    const Outcome outcome = run(program, {"-o", place});
    CHECK(outcome.status == 2);
    CHECK(says(outcome, program, place));
  }
}

TEST_CASE("no results take the place of what is read, whatever it is called") {
  const TemporaryFolder folder;
  const std::string model = folder.model("box.obj", solids::box({1, 2, 3})), bytes = bytes_of(model);
  std::filesystem::create_directory(folder / "results");
  for (const std::string& program : with_models) {
    std::filesystem::create_hard_link(model, folder / ("results/" + program + "_linked.csv"));
    const Outcome outcome = run(program, {model, "-o", folder / "results"});
    CHECK(outcome.status == 2);
    CHECK(says(outcome, program, "would replace"));
  }
  std::filesystem::create_directory(folder / "data");
  CHECK(!folder.file("data/study.csv", "precious").empty());
  const Outcome all = run("run_all", {"-o", folder / "data", "--paper-data", folder / "data"});
  CHECK(all.status == 2);
  CHECK(says(all, "run_all", "would replace"));
  CHECK(bytes_of(folder / "data/study.csv") == "precious");
  CHECK(bytes_of(model) == bytes);
}

TEST_CASE("results folders that are called like files are refused before they are made") {
  const TemporaryFolder folder;
  for (const std::string& program :
       with_models + std::vector<std::string>{"relations_against_lists", "run_all"}) {
    const Outcome outcome = run(program, {"-o", folder / "relations.csv"});
    CHECK(outcome.status == 2);
    CHECK(says(outcome, program, "called like a file"));
  }
  CHECK(folder.names().empty());
}

TEST_CASE("a broken model is named, and the others still have their rows") {
  const TemporaryFolder folder;
  const std::string good = folder.model("good.obj", solids::box({1, 2, 3}));
  const std::string broken = folder.file("broken.obj", "v 0 0 0\nf 1 2 3\n");
  for (const std::string& program : with_models) {
    const Outcome outcome = run(program, quick(program) + std::vector<std::string>{broken, good});
    CHECK(outcome.status == 3);
    CHECK(says(outcome, program, "broken.obj"));
    CHECK(outcome.out.find("\ngood,") != std::string::npos);
  }
}

TEST_CASE("a flat model is named too, although only its shape is at fault") {
  const TemporaryFolder folder;
  const std::string flat = folder.file("flat.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n");
  for (const std::string program :
       {"deformation_models", "direction_search", "envelope_accuracy", "place_accuracy"}) {
    const Outcome outcome = run(program, quick(program) + std::vector<std::string>{flat});
    CHECK(outcome.status == 3);
    CHECK(says(outcome, program, "flat.obj"));
  }
}

TEST_CASE("height maps of a ramp miss half a cell or an eighth, and are never too high") {
  const TemporaryFolder folder;
  Shape ramp = solids::box({1, 1, 1});
  for (auto corner : ramp.vertices.rowwise())
    if (corner.z() == 1) corner.z() += corner.x();
  const Outcome outcome =
      run("place_accuracy", {folder.model("ramp.obj", ramp), "--cells", "10", "--reach", "0.15"});
  REQUIRE(outcome.status == 0);
  const std::map<std::string, double> misses = {{"centre", 0.025}, {"extremes", 0.00625}};
  for (const auto& [look, miss] : misses) {
    const std::size_t at = outcome.out.find("10," + look + ",");
    REQUIRE(at != std::string::npos);
    std::istringstream cells(outcome.out.substr(at, outcome.out.find('\n', at) - at));
    std::vector<std::string> found;
    for (std::string cell; std::getline(cells, cell, ',');) found.push_back(cell);
    REQUIRE(found.size() >= 12);
    const auto value = [&](std::size_t k) { return std::stod(found[k]); };
    CHECK(value(2) == 9);                      // places
    CHECK(value(3) == (miss > 0.01 ? 1 : 0));  // share that is too low
    CHECK(value(4) == Approx(miss));           // deepest
    CHECK(value(5) == 0);                      // too high
    CHECK(value(6) == Approx(miss));           // median
    // A cell downhill: 1.9 of the height of 2; or all of the reach.
    for (const std::size_t k : {7, 8}) CHECK(value(k) == Approx(0.95));
    CHECK(value(9) == Approx(0.925));
    CHECK(value(10) <= 0.925);
    CHECK(value(10) >= 0.924);
  }
}

TEST_CASE("two runs leave the same bytes but for the clocks") {
  const TemporaryFolder folder;
  const std::string model = folder.model("box.obj", solids::box({1, 2, 3}));
  for (const std::string& program : with_models + std::vector<std::string>{"scaling"}) {
    const auto inputs = program == "scaling" ? std::vector<std::string>{} : std::vector<std::string>{model};
    for (const std::string& place : {folder / "first", folder / "second"})
      REQUIRE(run(program, quick(program) + inputs + std::vector<std::string>{"-o", place}).status == 0);
    for (const std::string ending : {".csv", ".json"}) {
      const std::string bytes = bytes_of(folder / ("first/" + program + ending));
      CHECK_FALSE(bytes.empty());
      CHECK(bytes == bytes_of(folder / ("second/" + program + ending)));
    }
    CHECK_FALSE(bytes_of(folder / ("first/" + program + ".clocks.csv")).empty());
  }
}

TEST_CASE("a study leaves the same rows for any number of threads") {
  const TemporaryFolder folder;
  for (const std::string threads : {"1", "2"})
    REQUIRE(
        run("study", quick("study") + std::vector<std::string>{"--threads", threads, "-o", folder / threads})
            .status == 0);
  for (const std::string table : {"/study.csv", "/study_summary.csv"}) {
    // The head of the table says how many threads there were.
    const std::string one = bytes_of(folder / ("1" + table)), two = bytes_of(folder / ("2" + table));
    CHECK(one.substr(one.find("\ntask,")) == two.substr(two.find("\ntask,")));
  }
}

TEST_CASE("run_all skips what is complete and repeats what is not") {
  const TemporaryFolder folder;
  const std::vector<std::string> arguments = {"-o", folder / "results", "--quick", "--only",
                                              "envelope_accuracy"};
  CHECK(run("run_all", arguments).out.starts_with("envelope_accuracy: done in "));
  CHECK(run("run_all", arguments).out == "envelope_accuracy: complete already\n");
  folder.file("results/envelope_accuracy.csv", "damaged");
  CHECK(run("run_all", arguments).out.starts_with("envelope_accuracy: done in "));
  CHECK(bytes_of(folder / "results/envelope_accuracy.csv").starts_with("# program: envelope_accuracy"));
}

TEST_CASE("run_all reports what fails and goes on") {
  const TemporaryFolder folder, data;
  data.file("broken.obj", "v 0 0 0\nf 1 2 3\n");
  const Outcome outcome = run("run_all", {"-o", folder / "results", "--paper-data", data.path().string(),
                                          "--quick", "--only", "minimal_translation", "deformation_speed"});
  CHECK(outcome.status == 1);
  CHECK(outcome.out.find("minimal_translation: FAILED with status 3") != std::string::npos);
  CHECK(outcome.out.find("deformation_speed: done") != std::string::npos);
}

TEST_CASE("the authors' tasks and results are rows, where their models are there") {
  const TemporaryFolder folder;
  CHECK(run("authors_designs", {}).status == 2);
  CHECK(says(run("authors_designs", {"--paper-data", folder / "nowhere"}), "authors_designs", "tasks.txt"));
  for (const char* place : {"user-study-graphics/UserStudyApp/data/Tasks", "stacker/data/RESULTS/Gallery"})
    std::filesystem::create_directories(folder / place);
  folder.file("user-study-graphics/UserStudyApp/tasks.txt",
              "data/Tasks/cup.obj 0.4\ndata/Tasks/chair.obj 0.6\n");
  folder.model("user-study-graphics/UserStudyApp/data/Tasks/cup.obj", solids::frustum_shell({}));
  // Theirs is wider above, and twice as large, which is no change.
  Shape wider = solids::frustum_shell({.outer_top = 4.4, .inner_top = 3.9});
  wider.vertices *= 2;
  folder.model("stacker/data/RESULTS/Gallery/30.obj", solids::frustum_shell({}));
  folder.model("stacker/data/RESULTS/Gallery/30_stackable.obj", wider);
  const Outcome outcome = run("authors_designs", {"--paper-data", folder.path().string(), "--effort", "0.1",
                                                  "-o", folder / "results"});
  CHECK(outcome.status == 3);  // the other results of theirs are not there
  const auto rows = [&](const std::string& table) {
    return nlohmann::json::parse(bytes_of(folder / ("results/authors_designs" + table + ".json")))["rows"];
  };
  const nlohmann::json tasks = rows(""), results = rows("_results");
  REQUIRE(tasks.size() == 1);
  CHECK(tasks[0]["model"] == "cup");
  CHECK(tasks[0]["target"] == 0.4);
  CHECK(tasks[0]["S_rest"].get<double>() > 0.4);  // it stacks as well at rest
  CHECK(tasks[0]["reached"] == true);
  CHECK(tasks[0]["change_rms"].get<double>() < 1e-12);
  REQUIRE(results.size() == 1);
  CHECK(results[0]["theirs_S"].get<double>() > results[0]["S_rest"].get<double>());
  CHECK(results[0]["theirs_change_rms"].get<double>() > 0.001);
  CHECK(results[0]["theirs_change_rms"].get<double>() < 0.05);
  CHECK(results[0]["theirs_breaks"] == "height");  // the similarity that fits best makes it less tall
}

#ifdef COMMAND_COSTS_BUILT
TEST_CASE("the costs of every command are listed for every model") {
  const Outcome outcome = run("command_costs", {"--largest-parts", "10", "--largest-triangles", "1000"});
  CHECK(outcome.status == 0);
  for (const std::string model : {"cubes,10,120,", "rack,10,120,", "coincident cubes,10,120,", "cup,1,968,"})
    for (const std::string command :
         {"inspect", "measure", "search", "map", "stack", "hold", "gap", "drop", "items", "draft", "validate",
          "structure", "deform", "suggest", "improve", "compare"}) {
      INFO(model + command);
      CHECK(outcome.out.find("\n" + model + command + ",") != std::string::npos);
    }
}
#endif
