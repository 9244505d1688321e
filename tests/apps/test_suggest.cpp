#include <algorithm>
#include <set>

#include "apps/table_folder.h"
#include "stackabilization/io/read.h"
#include "support/catch.h"

using namespace stackabilization;
using namespace stackabilization::apps;
using nlohmann::json;

namespace {

json suggested(const Arguments& arguments) {
  const Outcome outcome =
      run_program(joined({"suggest"}, joined(arguments, {"--boxes", "frame", "--json", "-", "--no-timing"})));
  INFO(outcome.err);
  REQUIRE((outcome.status == 0 || outcome.status == 1));
  CHECK(outcome.err.empty());
  return outcome.json();
}

/// Its suggestions: not a reference into a document that is gone.
json suggestions(const Arguments& arguments) {
  const json document = suggested(arguments);
  REQUIRE(!document["suggestions"].empty());
  return document["suggestions"];
}

double measured(const std::string& mesh) {
  return run_program({"measure", mesh, "--boxes", "frame", "--json", "-"})
      .json()["stackability"]
      .get<double>();
}

}  // namespace

TEST_CASE("suggestions are listed best first, with what each would do") {
  const TableProject folder;
  const json document = suggested({folder.project, "--top", "1000"});
  CHECK(document["command"] == "suggest");
  CHECK(document["applied"].is_null());
  CHECK(document["node"] == 0);
  CHECK(document["now"]["stackability"].get<double>() == Approx(measured(folder.table)).margin(1e-9));
  CHECK(document["now"]["height"].get<double>() == Approx(6).epsilon(1e-9));
  CHECK(document["now"]["energy"]["value"] == 0.0);
  CHECK(document["now"]["energy"]["alpha"] == 0.2);
  CHECK(document["now"]["energy"]["distortion"]["total"] == 0.0);
  CHECK(!document["contacts"].empty());
  const json& list = document["suggestions"];
  REQUIRE(list.size() == document["possible"].get<std::size_t>());
  REQUIRE(list.size() > 1);
  for (std::size_t k = 0; k < list.size(); ++k) {
    CHECK(list[k]["number"] == k + 1);
    CHECK(list[k]["refusal"].is_null());
    CHECK(!list[k]["why"].get<std::string>().empty());
    CHECK(list[k]["height"].get<double>() == Approx(6).epsilon(1e-9));
    if (k > 0)
      CHECK(list[k - 1]["energy"]["value"].get<double>() <= list[k]["energy"]["value"].get<double>());
  }
  CHECK(suggested({folder.project, "--top", "2"})["suggestions"].size() == 2);
  const json all = suggested({folder.project, "--all"});
  CHECK(all["suggestions"].size() == list.size() + all["refused"].get<std::size_t>());
}

TEST_CASE("a suggestion is what deform makes of its edit, the ends of the height fixed") {
  const TableProject folder;
  int different = 0;
  for (const json& one : suggestions({folder.project, "--top", "4"})) {
    const Arguments deform = {
        "deform", folder.project, "--edit", one["edit"].get<std::string>(), "--keep-extent", "0", "0", "1"};
    INFO(one["edit"]);
    const std::string fixed = folder / "fixed.obj", free = folder / "free.obj";
    REQUIRE(run_program(joined(deform, {"--extent-ends", "fixed", "-o", fixed})).status == 0);
    CHECK(measured(fixed) == Approx(one["stackability"].get<double>()).margin(1e-12));
    if (run_program(joined(deform, {"-o", free})).status == 0 && bytes_of(fixed) != bytes_of(free))
      ++different;
  }
  CHECK(different > 0);
}

TEST_CASE("a session: take one, take another, go back, take a third; the file is a tree") {
  const TableProject folder;
  const json start = suggested({folder.project});
  CHECK(bytes_of(folder.project).find("history") == std::string::npos);  // looking changes nothing
  const json one = suggested({folder.project, "--apply", "1"});
  CHECK(one["applied"] == 1);
  CHECK(one["history"]["current"] == 1);
  CHECK(one["suggestions"] == start["suggestions"]);
  const json next = suggested({folder.project});
  CHECK(next["node"] == 1);
  CHECK(next["now"]["stackability"] == start["suggestions"][0]["stackability"]);
  CHECK(next["now"]["energy"] == start["suggestions"][0]["energy"]);
  if (next["possible"] > 0) CHECK(suggested({folder.project, "--apply", "1"})["history"]["current"] == 2);

  const Outcome back = run_program({"suggest", folder.project, "--roll-back", "0"});
  CHECK(back.status == 0);
  CHECK(back.out.find("0 *") != std::string::npos);
  CHECK(suggested({folder.project})["suggestions"] == start["suggestions"]);
  const json third = suggested({folder.project, "--apply", "2"});
  const json nodes = third["history"]["nodes"];
  CHECK(nodes.back()["parent"] == 0);
  CHECK(nodes.back()["edits"][0] == start["suggestions"][1]["edit"]);
  const std::string tree = run_program({"suggest", folder.project, "--history"}).out;
  for (const json& node : nodes) CHECK(tree.find(node["name"].get<std::string>()) != std::string::npos);
}

TEST_CASE("a mesh gives the same session as its project file, once it is saved") {
  const TableProject folder;
  const std::string saved = folder / "session.json";
  const json from_mesh = suggested({folder.table, "--save", saved, "--apply", "1"});
  const json from_project = suggested({folder.project, "--apply", "1"});
  CHECK(from_mesh["suggestions"] == from_project["suggestions"]);
  CHECK(bytes_of(saved) == bytes_of(folder.project));
}

TEST_CASE("other commands start from the shape at rest; structure keeps the history, deform begins anew") {
  const TableProject folder;
  const Arguments deform = {"--edit", "top scale 1.1", "--keep-extent", "0", "0", "1"};
  const std::string before = folder / "before.obj", after = folder / "after.obj";
  REQUIRE(run_program(joined({"deform", folder.project, "-o", before}, deform)).status == 0);
  suggested({folder.project, "--apply", "1"});
  const std::string settled = folder / "settled.json", copy = folder / "copy.json";
  REQUIRE(run_program(joined({"deform", folder.project, "-o", after, "--save", settled}, deform)).status ==
          0);
  CHECK(bytes_of(before) == bytes_of(after));
  CHECK(bytes_of(settled).find("\"history\"") == std::string::npos);
  REQUIRE(run_program({"structure", folder.project, "--save", copy}).status == 0);
  CHECK(bytes_of(copy) == bytes_of(folder.project));
}

TEST_CASE("wishes hold: parts stay, targets are told, nothing possible ends with 1") {
  const TableProject folder;
  for (const json& one : suggestions({folder.project, "--target", "-5"}))
    CHECK(one["reaches_target"] == true);
  for (const json& one : suggestions({folder.project, "--target", "0.99"}))
    CHECK(one["reaches_target"] == false);
  Arguments fixed = {"suggest", folder.project};
  for (const std::string part : {"top", "leg_1", "leg_2", "leg_3", "leg_4"})
    fixed = joined(fixed, {"--keep", part});
  const Outcome outcome = run_program(fixed);
  CHECK(outcome.status == 1);
  CHECK(outcome.err.empty());
  for (const json& one : suggestions({folder.project, "--only", "leg_1", "--top", "1000"}))
    CHECK(one["edit"].get<std::string>().find("top") != 0);
}

TEST_CASE("an edit that changes nothing is no suggestion") {
  const TableProject folder;
  const Arguments squash = {folder.project, "--model", "gap-scaling", "--all"};
  const json kept = suggestions(squash);
  REQUIRE(kept.size() == 1);
  CHECK(kept[0]["number"].is_null());
  CHECK(kept[0]["refusal"] == "nothing would change");
  const Outcome told = run_program({"suggest", folder.project, "--model", "gap-scaling"});
  CHECK(told.status == 1);
  CHECK(told.out.find("1 more is refused: see --all") != std::string::npos);
  const json free = suggestions(joined(squash, {"--change-height"}));
  REQUIRE(free.size() == 1);
  CHECK(free[0]["refusal"].is_null());
}

TEST_CASE("what improve asks of designs can be asked of suggestions") {
  const TableProject folder;
  const json free = suggested({folder.project, "--top", "1000"});
  const json airy = suggested({folder.project, "--top", "1000", "--clearance", "0.1"});
  CHECK(airy["now"]["f_max"].get<double>() == Approx(free["now"]["f_max"].get<double>() + 0.1));
  const json toppling = suggested({folder.project, "--standing", "3", "--tilt-degrees", "89", "--all"});
  CHECK(free["possible"] > 0);
  CHECK(toppling["possible"] == 0);
  CHECK(toppling["suggestions"][0]["refusal"].get<std::string>().find("standing") != std::string::npos);
  for (const Arguments& wrong : {Arguments{"--tilt-degrees", "5"}, Arguments{"--target", "1"},
                                 Arguments{"--clearance", "1e300"}, Arguments{"--draft-degrees", "91"},
                                 Arguments{"--thickness", "-1"}, Arguments{"--keep", "top", "--only", "top"}})
    CHECK(run_program(joined({"suggest", folder.project}, wrong)).status == 2);
}

TEST_CASE("suggestions, and project files, do not depend on the number of threads") {
  const TableProject folder;
  const std::string a = folder / "a.json", b = folder / "b.json";
  const json one = suggested({folder.project, "--apply", "1", "--save", a, "--threads", "1"});
  const json three = suggested({folder.project, "--apply", "1", "--save", b, "--threads", "3"});
  CHECK(one == three);
  CHECK(bytes_of(a) == bytes_of(b));
}

TEST_CASE("wrong uses of suggest end with 2, broken histories with 3, and nothing is written") {
  const TableProject folder;
  const std::vector<std::pair<Arguments, std::string>> cases = {
      {{folder.table, "--apply", "1"}, "--save"},
      {{folder.project, "--roll-back", "0"}, "none yet"},
      {{folder.project, "--apply", "100000"}, "--apply expects the number of a suggestion"},
      {{folder.project, "--apply", "0"}, "--apply"},
      {{folder.project, "--apply", "1", "--history"}, "--history"},
      {{folder.project, "--apply", "1", "--all"}, "--all"},
      {{folder.project, "--keep", "lid"}, "'lid'"},
      {{folder.project, "--only", "lid"}, "'lid'"},
      {{folder.project, "--alpha", "2"}, "alpha"},
      {{folder.project, "--target", "1"}, "below 1"},
      {{folder.project, "--model", "clay"}, "controllers|surface"},
      {{folder.project, "--save", folder / "a.obj"}, ".json"},
      {{folder.project, "--top", "0"}, "--top"}};
  for (const auto& [arguments, message] : cases)
    check_refused(folder, joined({"suggest"}, arguments), 2, message);

  suggested({folder.project, "--apply", "1"});
  CHECK(run_program({"suggest", folder.project, "--roll-back", "7"}).status == 2);
  CHECK(run_program({"suggest", folder.project, "--model", "surface"}).status == 2);
  std::string text = bytes_of(folder.project);
  const std::size_t at = text.find("\"parent\":0");
  REQUIRE(at != std::string::npos);
  const std::string broken = folder.file("broken.json", text.replace(at, 10, "\"parent\":9"));
  for (const char* command : {"suggest", "structure", "deform"}) {
    const Outcome outcome = run_program({command, broken, "--json", "-"});
    INFO(outcome.err);
    CHECK(outcome.status == (std::string(command) == "deform" ? 2 : 3));
    if (outcome.status == 3) CHECK(outcome.err.find("/history/nodes/1/parent") != std::string::npos);
  }
}
