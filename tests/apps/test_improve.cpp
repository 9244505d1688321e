#include <signal.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <map>
#include <numbers>
#include <pugixml.hpp>
#include <set>

#include "apps/run_program.h"
#include "stackabilization/io/read.h"
#include "stackabilization/stacking/stackability.h"
#include "support/catch.h"
#include "support/solids.h"
#include "support/structures.h"

using namespace stackabilization;
using namespace stackabilization::apps;
using nlohmann::json;

namespace {

namespace fs = std::filesystem;

solids::FrustumShell coarse() {
  solids::FrustumShell cup;
  cup.segments = 16;
  return cup;
}

/// A cup that a search of a second makes stack better, and the folder for what is found.
struct ImprovableCup : TemporaryFolder {
  std::string cup = model("cup.obj", solids::frustum_shell(coarse()));
  std::string out = *this / "out";

  double stackability_now() const { return stackability(read_shape(cup), {0, 0, 1}).value; }
  /// A search along z, without pictures.
  Arguments along_z(const Arguments& further) const {
    return joined({"improve", cup, "--direction", "0", "0", "1", "--no-timing", "--no-pictures", "-o", out},
                  further);
  }
  /// A little more than it has.
  Arguments more(int solutions = 1) const {
    return along_z({"--target", std::to_string(stackability_now() + 0.04), "--expansions", "40",
                    "--solutions", std::to_string(solutions)});
  }
  std::string written(const std::string& name) const { return bytes_of((fs::path(out) / name).string()); }
  json document(const std::string& name) const { return json::parse(written(name)); }
};

std::set<std::string> names_in(const std::string& folder) {
  std::set<std::string> names;
  for (const auto& entry : fs::directory_iterator(folder)) names.insert(entry.path().filename().string());
  return names;
}

/// Well-formed, and all it refers to is there.
void check_page(const std::string& folder) {
  const std::string bytes = bytes_of((fs::path(folder) / "index.html").string());
  pugi::xml_document page;
  const pugi::xml_parse_result parsed = page.load_string(bytes.c_str(), pugi::parse_full);
  INFO(parsed.description() << " at " << parsed.offset);
  CHECK(parsed.status == pugi::status_ok);
  CHECK(bytes.find("http", bytes.find("<body>")) == std::string::npos);
  int references = 0;
  for (const char* path : {"//img/@src", "//a/@href"})
    for (const pugi::xpath_node& node : page.select_nodes(path)) {
      INFO(node.attribute().value());
      CHECK(fs::exists(fs::path(folder) / node.attribute().value()));
      ++references;
    }
  CHECK(references >= 4);
}

void check_solution(const ImprovableCup& folder, const json& solution) {
  const std::string name = solution["name"];
  INFO(name);
  CHECK(folder.document(name + ".json") == solution);
  for (const char* ending : {".obj", ".3mf", ".stackabilize.json"})
    CHECK(!folder.written(name + ending).empty());
  const Shape shape = read_shape((fs::path(folder.out) / (name + ".obj")).string());
  const Shape rest = read_shape(folder.cup);
  const Stackability measured = stackability(shape, {0, 0, 1});
  CHECK(solution["stackability"].get<double>() == Approx(measured.value).epsilon(1e-9));
  CHECK(measured.value >= solution["target"].get<double>() - 1e-9);
  CHECK(measured.extent == Approx(stackability(rest, {0, 0, 1}).extent).epsilon(1e-9));
  const json& terms = solution["energy"]["distortion"];
  const double total = terms["volume"].get<double>() + terms["proximity"].get<double>() +
                       terms["box"].get<double>() + terms["symmetry"].get<double>();
  CHECK(terms["total"].get<double>() == Approx(total / 4));
  CHECK(solution["energy"]["gain"].get<double>() ==
        Approx(solution["stackability"].get<double>() - solution["stackability_before"].get<double>()));
  CHECK(solution["energy"]["value"].get<double>() ==
        Approx(0.2 * total / 4 - 0.8 * solution["energy"]["gain"].get<double>()));
  CHECK(!solution["edits"].empty());
  CHECK(!solution["explanation"]["lines"].empty());
  CHECK(solution["good"] == true);
  const json& along = solution["direction"];
  const double sine = std::hypot(along[0].get<double>(), along[1].get<double>()) /
                      std::hypot(along[0].get<double>(), along[1].get<double>(), along[2].get<double>());
  CHECK(solution["stack"]["drift"].get<double>() ==
        Approx((solution["stack"]["copies"].get<int>() - 1) * measured.f_max * sine).margin(1e-9));
  CHECK(solution["checks"].size() >= 4);
  for (const json& check : solution["checks"]) CHECK(check["verdict"] == "agrees");
  for (const json& requirement : solution["requirements"]) CHECK(requirement["passed"] == true);
  for (const json& relation : solution["relations"]) CHECK(relation["residual"].get<double>() < 1e-6);
}

}  // namespace

TEST_CASE("a cup is made to stack: solutions, best first, that are what they say") {
  const ImprovableCup folder;
  const Outcome outcome = run_program(folder.more(2));
  INFO(outcome.err << outcome.out);
  REQUIRE(outcome.status == 0);
  CHECK(outcome.err.empty());
  CHECK(outcome.out.find("Reached: ") != std::string::npos);
  const json result = folder.document("result.json");
  CHECK(result["command"] == "improve");
  CHECK(result["reached"] == true);
  CHECK(result["nearest"].is_null());
  CHECK(result["diagnosis"].is_null());
  REQUIRE(!result["solutions"].empty());
  double energy = -1;
  for (const json& solution : result["solutions"]) {
    check_solution(folder, solution);
    CHECK(solution["energy"]["value"].get<double>() >= energy);
    energy = solution["energy"]["value"];
  }
  check_page(folder.out);
  CHECK(!names_in(folder.out).contains("search-state.json"));
}

TEST_CASE("suggest goes on from the solutions, and back to the shape at rest") {
  const ImprovableCup folder;
  REQUIRE(run_program(folder.more(2)).status == 0);
  const json solutions = folder.document("result.json")["solutions"];
  const std::string project = folder.out + "/solutions.stackabilize.json";
  const auto suggested = [&](const Arguments& further) {
    const Outcome outcome = run_program(joined({"suggest", project, "--json", "-", "--top", "1"}, further));
    INFO(outcome.err);
    REQUIRE(outcome.status == 0);
    return outcome.json();
  };
  const json now = suggested({});
  CHECK(now["node"] == 1);
  CHECK(now["now"]["stackability"].get<double>() ==
        Approx(solutions[0]["stackability"].get<double>()).margin(1e-9));
  CHECK(now["history"]["nodes"].size() == 1 + solutions.size());
  const json rest = suggested({"--roll-back", "0", "--apply", "1", "--save", folder / "other.json"});
  CHECK(rest["node"] == 0);
  CHECK(rest["now"]["stackability"].get<double>() == Approx(folder.stackability_now()).margin(1e-9));
}

TEST_CASE("a front has a curve of designs from rest to the target, in JSON, CSV and on the page") {
  const ImprovableCup folder;
  const double target = folder.stackability_now() + 0.04;
  const Outcome outcome = run_program({"improve", folder.cup, "--direction", "0", "0", "1", "--no-timing",
                                       "--no-pictures", "-o", folder.out, "--front", "--target",
                                       std::to_string(target), "--solutions", "3", "--effort", "0.05"});
  INFO(outcome.err << outcome.out);
  REQUIRE(outcome.status == 0);
  const json document = folder.document("result.json");
  REQUIRE(document["front"].size() == 4);
  CHECK(document["front"][0]["name"] == nullptr);
  CHECK(document["front"][0]["change"] == 0);
  for (std::size_t k = 1; k < 4; ++k) {
    const json& point = document["front"][k];
    CHECK(point["name"] == "solution_" + std::to_string(k));
    CHECK(point["change"].get<double>() >= document["front"][k - 1]["change"].get<double>());
    CHECK(document["solutions"][k - 1]["target"] == point["target"]);
    CHECK(point["stackability"].get<double>() >= point["target"].get<double>() - 1e-9);
    check_solution(folder, document["solutions"][k - 1]);
  }
  const std::string table = folder.written("front.csv");
  CHECK(std::count(table.begin(), table.end(), '\n') == 5);
  CHECK(table.starts_with("target,stackability,change,f_max,edits,name,words\n"));
  check_page(folder.out);
}

TEST_CASE("a front refuses what has no place in it") {
  const ImprovableCup folder;
  for (const Arguments& more : {Arguments{"--copies", "3", "--within", "20"}, Arguments{"--preset", "paper"},
                                Arguments{"--time", "9"}, Arguments{"--resume"}}) {
    const Outcome outcome = run_program(joined({"improve", folder.cup, "--front", "-o", folder.out}, more));
    CHECK(outcome.status == 2);
    CHECK(outcome.err.find("--front") != std::string::npos);
  }
}

TEST_CASE("edits of a solution make the same file with deform") {
  const ImprovableCup folder;
  REQUIRE(run_program(folder.more()).status == 0);
  const json solution = folder.document("solution_1.json");
  const std::string again = folder / "again.obj";
  Arguments deform = {"deform", folder.cup, "--follow", "smooth",       "--extent-ends",
                      "fixed",  "-o",       again,      "--keep-extent"};
  for (const json& x : solution["direction"]) deform.push_back(x.dump());
  for (const json& edit : solution["edits"])
    deform = joined(deform, {"--edit", edit["text"].get<std::string>()});
  REQUIRE(run_program(deform).status == 0);
  CHECK(bytes_of(again) == folder.written("solution_1.obj"));
}

TEST_CASE("the same bytes for any number of threads, on paper and on standard output") {
  const ImprovableCup one, two;
  const Outcome first = run_program(joined(one.more(), {"--threads", "1", "--json", "-"}));
  const Outcome second = run_program(joined(two.more(), {"--threads", "2", "--json", "-"}));
  CHECK(first.status == 0);
  CHECK(first.json()["solutions"] == second.json()["solutions"]);
  CHECK(first.out == one.written("result.json"));
  const std::map<std::string, std::string> a = contents(one.out), b = contents(two.out);
  REQUIRE(a.size() == b.size());
  for (const auto& [name, bytes] : a) {
    INFO(name);
    REQUIRE(b.contains(name));
    // It names the model's folder, and the list has its hash.
    if (name != "result.json" && name != "stackabilize-files.json") CHECK(b.at(name) == bytes);
  }
}

TEST_CASE("so many copies within a length become a target, and the stack fits") {
  const ImprovableCup folder;
  const Stackability now = stackability(read_shape(folder.cup), {0, 0, 1});
  const double room = now.extent + 9 * now.f_max * 0.95;
  const Outcome outcome =
      run_program({"improve", folder.cup, "--copies", "10", "--within", std::to_string(room), "--boxes",
                   "frame", "--solutions", "1", "-o", folder.out});
  INFO(outcome.err << outcome.out);
  REQUIRE(outcome.status == 0);
  const json result = folder.document("result.json");
  CHECK(result["target"]["copies"] == 10);
  CHECK(result["target"]["directions"] == json::parse("[[0.0, 0.0, 1.0]]"));
  const json& stack = result["solutions"][0]["stack"];
  CHECK(stack["copies"] == 10);
  CHECK(stack["height"].get<double>() <= room);
  CHECK(stack["height"].get<double>() == Approx(room).epsilon(1e-6));
  CHECK(result["solutions"][0]["requirements"][0]["name"] == "room");
  CHECK(stack["height_before"].get<double>() == Approx(now.extent + 9 * now.f_max));
  CHECK(stack["fits"] == true);
}

TEST_CASE("up is the axis of a cup that stands aslant by half a degree") {
  const ImprovableCup folder;
  const double angle = 0.5 * std::numbers::pi / 180;
  const Eigen::Matrix3d turn = Eigen::AngleAxisd(angle, Eigen::Vector3d::UnitX()).toRotationMatrix();
  const std::string aslant =
      folder.model("aslant.obj", transformed(solids::frustum_shell(coarse()), turn, {0, 0, 0}));
  const Outcome outcome =
      run_program({"improve", aslant, "--copies", "2", "--within", "100", "--no-pictures", "-o", folder.out});
  INFO(outcome.err << outcome.out);
  REQUIRE(outcome.status == 0);
  const json direction = folder.document("result.json")["target"]["directions"][0];
  const Eigen::Vector3d r(direction[0], direction[1], direction[2]);
  CHECK((r.normalized() - turn.col(2)).norm() < 0.1 * angle);
}

TEST_CASE("a target that is met already has one solution, the shape as it is") {
  const ImprovableCup folder;
  const Outcome outcome = run_program(folder.along_z({"--target", "-1", "--solutions", "3"}));
  INFO(outcome.err << outcome.out);
  CHECK(outcome.status == 0);
  CHECK(outcome.out.find("S of at least -1 along z") != std::string::npos);
  CHECK(outcome.out.find("about as high") != std::string::npos);
  CHECK(outcome.out.find("solution_1  0.46875  along z    0  0  0.0 %") != std::string::npos);
  const json solutions = folder.document("result.json")["solutions"];
  REQUIRE(solutions.size() == 1);
  CHECK(solutions[0]["edits"].empty());
}

TEST_CASE("a target out of reach ends with 1, what came nearest and the reason") {
  const ImprovableCup folder;
  const std::string part = read_shape(folder.cup).part_names[0];
  const Outcome told = run_program(folder.along_z({"--target", "0.9", "--keep", part, "--expansions", "5"}));
  INFO(told.err << told.out);
  CHECK(told.status == 1);
  CHECK(told.err.empty());
  CHECK(told.out.find("Not reached.") != std::string::npos);
  const json result = folder.document("result.json");
  CHECK(result["reached"] == false);
  CHECK(result["solutions"].empty());
  CHECK(result["nearest"]["name"] == "nearest");
  CHECK(result["diagnosis"]["reached"].get<double>() == Approx(folder.stackability_now()));
  CHECK(!result["diagnosis"]["text"].get<std::string>().empty());
  const std::set<std::string> names = names_in(folder.out);
  CHECK(names.contains("nearest.obj"));
  CHECK(!names.contains("solution_1.obj"));
  check_page(folder.out);
  CHECK(folder.written("index.html").find("would help") != std::string::npos);
}

TEST_CASE("what stacks better taken apart is written in pieces, with the S of each") {
  struct MugFolder : TemporaryFolder {
    std::string mug = model("mug.obj", structures::mug().shape), out = *this / "out";
    Arguments asked(const std::string& target) const {
      return {"improve",      mug, "--direction",   "0",  "0", "1", "--target", target,
              "--expansions", "3", "--no-pictures", "-o", out};
    }
  };
  const MugFolder folder;
  REQUIRE(run_program(folder.asked("0.99")).status == 1);
  const json result = json::parse(bytes_of((fs::path(folder.out) / "result.json").string()));
  const json& remedies = result["diagnosis"]["remedies"];
  const auto offer =
      std::find_if(remedies.begin(), remedies.end(), [](const json& one) { return !one["pieces"].empty(); });
  REQUIRE(offer != remedies.end());
  const Shape whole = read_shape(folder.mug);
  double wasted = 0;
  std::vector<std::string> names;
  for (std::size_t k = 0; k < (*offer)["pieces"].size(); ++k) {
    const json& piece = (*offer)["pieces"][k];
    const Shape shape =
        read_shape((fs::path(folder.out) / ("piece_" + std::to_string(k + 1) + ".obj")).string());
    CHECK(json(shape.part_names) == piece["parts"]);
    names.insert(names.end(), shape.part_names.begin(), shape.part_names.end());
    const auto direction = piece["direction"].get<std::vector<double>>();
    const Stackability measured = stackability(shape, {direction[0], direction[1], direction[2]});
    CHECK(piece["stackability"].get<double>() == Approx(measured.value));
    wasted += measured.box_volume * (1 - measured.value);
  }
  CHECK(names == whole.part_names);
  const Stackability at_rest = stackability(whole, {0, 0, 1});
  CHECK((*offer)["stackability"].get<double>() == Approx(1 - wasted / at_rest.box_volume));
  check_page(folder.out);
  // They are files of that run: one that reaches its target leaves none of them.
  REQUIRE(run_program(folder.asked(std::to_string(at_rest.value - 1e-4))).status == 0);
  for (const std::string& name : names_in(folder.out)) CHECK(!name.starts_with("piece_"));
}

TEST_CASE("files of an earlier run go, other files stay") {
  const ImprovableCup folder;
  REQUIRE(
      run_program(folder.along_z({"--target", "0.97", "--preset", "paper", "--expansions", "3"})).status ==
      1);
  for (const char* there : {"nearest.obj", "nearest.json", "search-state.json", "stackabilize-files.json"})
    CHECK(names_in(folder.out).contains(there));
  for (const char* name : {"out/solution_x.obj", "out/notes.txt", "out/solution_.json"})
    CHECK(!folder.file(name, "old").empty());
  REQUIRE(run_program(folder.more()).status == 0);
  const std::set<std::string> names = names_in(folder.out);
  for (const char* gone : {"nearest.obj", "nearest.json", "search-state.json"}) CHECK(!names.contains(gone));
  for (const char* there : {"solution_x.obj", "notes.txt", "solution_.json", "solution_1.obj"})
    CHECK(names.contains(there));
  CHECK(folder.written("notes.txt") == "old");
  const json list = folder.document("stackabilize-files.json")["files"];
  for (const auto& [name, hash] : list.items()) {
    CHECK(names.contains(name));
    CHECK(hash.is_string());
  }
  CHECK(list.size() + 4 == names.size());  // the list itself, and the three others
}

TEST_CASE("a file of an earlier run that was changed since stays, and is named") {
  const ImprovableCup folder;
  REQUIRE(run_program(folder.more()).status == 0);
  const std::string project = folder.out + "/solutions.stackabilize.json";
  REQUIRE(run_program({"suggest", project, "--roll-back", "0"}).status == 0);
  const std::string changed = bytes_of(project);
  const auto before = contents(folder.out);
  check_refused(folder, folder.more(), 2, "solutions.stackabilize.json is in the way: it was changed");
  CHECK(contents(folder.out) == before);
  fs::rename(project, folder / "mine.json");
  CHECK(run_program(folder.more()).status == 0);
  CHECK(bytes_of(folder / "mine.json") == changed);
}

TEST_CASE("a folder that has only the state of a search is gone on with, by its content") {
  const ImprovableCup folder;
  const auto far = [&](const char* expansions) {
    return folder.along_z({"--target", "0.97", "--preset", "paper", "--expansions", expansions});
  };
  REQUIRE(run_program(far("3")).status == 1);
  for (const auto& entry : fs::directory_iterator(folder.out))
    if (entry.path().filename() != "search-state.json") fs::remove(entry.path());
  CHECK(run_program(joined(far("4"), {"--resume"})).status == 1);
  CHECK(folder.document("result.json")["search"]["expanded"] == 4);
}

TEST_CASE("names that mean something in HTML do not break the page") {
  const ImprovableCup folder;
  Shape cup = read_shape(folder.cup);
  cup.part_names[0] = "<b>a&b'\"]]>";
  const std::string model = folder.model("<i>&'\"\xc3\xa9.obj", cup);
  Arguments arguments = folder.more();
  arguments[1] = model;
  REQUIRE(run_program(arguments).status == 0);
  check_page(folder.out);
  const std::string page = folder.written("index.html");
  CHECK(page.find("<i>") == std::string::npos);
  CHECK(page.find("&lt;b&gt;a&amp;b") != std::string::npos);
}

TEST_CASE("an interrupted run says what it has, and goes on to the same result") {
  const ImprovableCup folder, whole;
  const auto far = [](const ImprovableCup& where, std::int64_t expansions) {
    return where.along_z(
        {"--target", "0.97", "--preset", "paper", "--expansions", std::to_string(expansions)});
  };
  const Outcome stopped = run_and_signal(far(folder, 1000000), SIGINT, [&](pid_t) {
    const json state = json::parse(bytes_of(folder.out + "/search-state.json"), nullptr, false);
    return state.is_object() && state["expanded"] > 0;
  });
  INFO(stopped.err << stopped.out);
  REQUIRE(stopped.status == 130);
  CHECK(stopped.err == "stackabilize: interrupted\n");
  CHECK(stopped.out.find("interrupted; --resume goes on") != std::string::npos);
  CHECK(names_in(folder.out).contains("search-state.json"));
  check_page(folder.out);
  // However far that was: a few steps more, in two runs and in one.
  const std::int64_t expansions =
      folder.document("result.json")["search"]["expanded"].get<std::int64_t>() + 3;
  const Outcome resumed = run_program(joined(far(folder, expansions), {"--resume"}));
  const Outcome at_once = run_program(far(whole, expansions));
  CHECK(resumed.status == at_once.status);
  json a = folder.document("result.json"), b = whole.document("result.json");
  a["model"] = b["model"];
  CHECK(a == b);
}

TEST_CASE("a resumed run starts anew where there is nothing, and refuses the state of another search") {
  const ImprovableCup folder;
  const Outcome anew = run_program(joined(folder.more(), {"--resume"}));
  CHECK(anew.status == 0);
  CHECK(is_one_sentence(anew.err));
  CHECK(anew.err.find("starts anew") != std::string::npos);
  CHECK(run_program(joined(folder.more(), {"--resume", "--quiet"})).err.empty());
  for (const auto& [state, words] : std::vector<std::pair<std::string, std::string>>{
           {"", "search-state.json:1: expected JSON, found something else at byte"},
           {"{}", "search-state.json: /: this is no saved search of this version"},
           {"state", "search-state.json:1: expected JSON"},
           {"{\"format\": \"stackabilization search\", \"version\": 3}",
            "search-state.json: /: this is no saved search of this version"},
           {"{\"format\": \"stackabilization search\", \"version\": 6}",
            "search-state.json: /: the key 'task' is missing"}}) {
    CHECK(!folder.file("out/search-state.json", state).empty());
    check_refused(folder, joined(folder.more(), {"--resume"}), 3, words);
  }
}

TEST_CASE("a run without --time is the same for every machine, and --effort says how much it does") {
  const ImprovableCup folder;
  const auto run = [&](const std::string& effort, const Arguments& further) {
    return run_program(joined({"improve", folder.cup, "--target", "0.97", "--effort", effort, "--any-quality",
                               "--no-pictures", "--json", "-", "-o", folder.out},
                              further));
  };
  const Outcome one = run("0.01", {"--threads", "1", "--no-timing"});
  CHECK(one.status == 1);
  CHECK(one.out == run("0.01", {"--threads", "3", "--no-timing"}).out);
  const json little = one.json()["search"], more = run("0.05", {}).json()["search"];
  CHECK(little["end"] == "effort");
  CHECK(little["evaluated"].get<int>() < more["evaluated"].get<int>());
  CHECK(run_program(joined(folder.more(), {"--effort", "0"})).status == 2);
}

TEST_CASE("a deadline that is met is told, and its run goes on with the directions that it had") {
  const ImprovableCup folder, whole;
  const auto task = [](const ImprovableCup& where, const Arguments& further) {
    return joined({"improve", where.cup, "--target", "0.97", "--effort", "0.01", "--no-pictures",
                   "--no-timing", "-o", where.out},
                  further);
  };
  const Outcome late = run_program(task(folder, {"--time", "1e-9"}));
  INFO(late.err << late.out);
  CHECK(late.status == 1);
  CHECK(late.out.find("stopped after the seconds of --time; --resume goes on") != std::string::npos);
  CHECK(folder.document("result.json")["search"]["end"] == "time limit");
  CHECK(folder.document("search-state.json")["directions"] == json::parse("[[0.0, 0.0, 1.0]]"));
  CHECK(run_program(task(folder, {"--resume"})).status == 1);
  CHECK(run_program(task(whole, {"--direction", "0", "0", "1", "--cone-degrees", "10"})).status == 1);
  json a = folder.document("result.json"), b = whole.document("result.json");
  a["model"] = b["model"];
  CHECK(a == b);
}

TEST_CASE("a direction that is given is kept, one that is free may turn, and each S names its own") {
  const TemporaryFolder folder;
  const std::string model =
      (fs::path(STACKABILIZATION_SOURCE_DIR) / "data" / "models" / "chair.obj").string();
  const auto directions_of = [&](const Arguments& further) {
    const Outcome outcome =
        run_program(joined({"improve", model, "--target", "0.99", "--preset", "paper", "--expansions", "1",
                            "--no-pictures", "--json", "-", "-o", folder / "out"},
                           further));
    INFO(outcome.err);
    REQUIRE(outcome.status == 1);
    const json nearest = outcome.json()["nearest"];
    for (const char* side : {"before", "after"}) CHECK(nearest[side]["direction"] == nearest["direction"]);
    CHECK(outcome.json()["diagnosis"]["direction"] == nearest["direction"]);
    return nearest["direction"];
  };
  const json up = json::parse("[0.0, 0.0, 1.0]");
  CHECK(directions_of({"--direction", "0", "0", "1"}) == up);
  CHECK(directions_of({"--direction", "0", "0", "1", "--change-height", "--cone-degrees", "10"}) != up);
}

TEST_CASE("stack and improve name the same stackability for the same copies in the same room") {
  const ImprovableCup folder;
  const Stackability now = stackability(read_shape(folder.cup), {0, 0, 1});
  const std::string room = std::to_string(now.extent + 4 * 0.8 * now.f_max);
  for (const Arguments& air :
       {Arguments{}, Arguments{"--clearance", "0.05"}, Arguments{"--lateral-clearance", "0.01"},
        Arguments{"--clearance", "0.05", "--lateral-clearance", "0.01"}}) {
    const json stacked =
        run_program(joined({"stack", folder.cup, "-n", "5", "--within", room, "--json", "-"}, air)).json();
    run_program(joined({"improve", folder.cup, "--copies", "5", "--within", room, "--effort", "0.001",
                        "--no-pictures", "-o", folder.out},
                       air));
    const double wished = stacked["within"]["straight"]["stackability"];
    CHECK(wished == folder.document("result.json")["target"]["stackability"].get<double>());
    CHECK(wished == Approx(1 - 0.8 * (1 - now.value)).epsilon(1e-5));
  }
  check_refused(
      folder,
      {"improve", folder.cup, "--copies", "5", "--within", room, "--clearance", "100", "-o", folder.out}, 2,
      "of air between them");
}

TEST_CASE("a part that is not there is answered with those that are, in every option") {
  const TemporaryFolder folder;
  const std::string table =
                        (fs::path(STACKABILIZATION_SOURCE_DIR) / "data" / "models" / "chair.obj").string(),
                    cup = folder.model("cup.obj", solids::frustum_shell(coarse())), out = folder / "out";
  for (const Arguments& arguments :
       std::vector<Arguments>{{"improve", table, "--target", "0.5", "-o", out, "--keep", "Seat"},
                              {"improve", table, "--target", "0.5", "-o", out, "--only", "Seat"},
                              {"improve", table, "--target", "0.5", "-o", out, "--remove", "Seat"},
                              {"suggest", table, "--keep", "Seat"},
                              {"deform", table, "--edit", "seat move 0 0 0.01", "--fix", "Seat"},
                              {"deform", table, "--edit", "Seat move 0 0 0.01"},
                              {"structure", table, "--primitive", "Seat=cuboid"}})
    check_refused(folder, arguments, 2, "there is no part 'Seat', only 'seat', ");
  check_refused(folder, {"improve", cup, "--target", "0.5", "-o", out, "--keep", "handle"}, 2,
                "there is no part 'handle', only ");
}

TEST_CASE("wrong uses of improve end with 2, name the mistake and leave no folder") {
  const ImprovableCup folder;
  const std::string& cup = folder.cup;
  const Arguments good = {"improve", cup, "-o", folder.out}, target = {"--target", "0.5"};
  const std::vector<std::pair<Arguments, std::string>> cases = {
      {{"improve", cup, "--target", "0.5"}, "--output"},
      {good, "expected --target S"},
      {joined(good, {"--target", "1"}), "below 1"},
      {joined(good, {"--target", "nan"}), "--target"},
      {joined(good, {"--target", "0.5", "--copies", "3", "--within", "9"}), "two ways"},
      {joined(good, {"--copies", "3"}), "go together"},
      {joined(good, {"--within", "3"}), "go together"},
      {joined(good, {"--copies", "1", "--within", "30"}), "--copies"},
      {joined(good, {"--copies", "3", "--within", "0"}), "above 0"},
      {joined(good, {"--copies", "3", "--within", "7"}), "no room"},
      {joined(good, {"--copies", "3", "--within", "2m"}), "--unit"},
      {joined(good, {"--copies", "3", "--within", "30", "--direction", "0", "0", "1", "--direction", "1", "0",
                     "0"}),
       "given once"},
      {joined(good, joined(target, {"--direction", "0", "0", "0"})), "zero"},
      {joined(good, joined(target, {"--direction", "0", "0"})), "--direction"},
      {joined(good, joined(target, {"--keep", "lid"})), "'lid'"},
      {joined(good, joined(target, {"--only", "lid"})), "'lid'"},
      {joined(good, joined(target, {"--remove", "lid"})), "'lid'"},
      {joined(good, joined(target, {"--keep", "lid", "--only", "lid"})), "contradict"},
      {joined(good, joined(target, {"--solutions", "0"})), "--solutions"},
      {joined(good, joined(target, {"--model", "clay"})), "controllers|surface"},
      {joined(good, joined(target, {"--preset", "best"})), "paper|refined"},
      {joined(good, joined(target, {"--box-tolerance", "5"})), "5%"},
      {joined(good, joined(target, {"--box-tolerance", "-1%"})), "--box-tolerance"},
      {joined(good, joined(target, {"--thickness", "-1"})), "--thickness"},
      {joined(good, joined(target, {"--clearance", "2mm"})), "--unit"},
      {joined(good, joined(target, {"--clearance", "1e50"})), "a million times"},
      {joined(good, joined(target, {"--cone-degrees", "91"})), "--cone-degrees"},
      {joined(good, joined(target, {"--model", "gap-scaling", "--cone-degrees", "5"})),
       "keeps the direction"},
      {joined(good, joined(target, {"--draft-degrees", "-1"})), "--draft-degrees"},
      {joined(good, joined(target, {"--tilt-degrees", "5"})), "--standing"},
      {joined(good, joined(target, {"--standing", "0"})), "--standing"},
      {joined(good, joined(target, {"--time", "0"})), "--time"},
      {joined(good, joined(target, {"--expansions", "0"})), "--expansions"},
      {joined(good, joined(target, {"--alpha", "1.5"})), "--alpha"},
      {{"improve", cup, "--target", "0.5", "-o", cup}, "not a folder"},
      {{"improve", cup, "--target", "0.5", "-o", cup + "/out"}, "not a folder"},
      {{"improve", cup, "--target", "0.5", "-o", "-"}, "folder"},
      {{"improve", cup, "--target", "0.5", "-o", ""}, "folder"},
  };
  for (const auto& [arguments, words] : cases) check_refused(folder, arguments, 2, words);
}

TEST_CASE("improve replaces no file that it reads") {
  const ImprovableCup folder;
  fs::create_directory(folder.out);
  const std::string model = folder.out + "/solution_2.obj";
  fs::copy_file(folder.cup, model);
  const std::string bytes = bytes_of(model);
  for (const Arguments& arguments :
       std::vector<Arguments>{{"improve", model, "--target", "0.5", "-o", folder.out},
                              {"improve", model, "--target", "0.5", "-o", folder.out + "/../out/."},
                              {"improve", folder.cup, "--labels", folder.out + "/result.json", "--target",
                               "0.5", "-o", folder.out},
                              {"improve", folder.cup, "--json", folder.out + "/index.html", "--target", "0.5",
                               "-o", folder.out}}) {
    const Outcome outcome = run_program(arguments);
    INFO(outcome.err);
    CHECK(outcome.status == 2);
    CHECK(outcome.err.find("would replace") != std::string::npos);
  }
  CHECK(bytes_of(model) == bytes);
  CHECK(names_in(folder.out) == std::set<std::string>{"solution_2.obj"});
}
