#include <Eigen/Core>
#include <algorithm>

#include "apps/table_folder.h"
#include "stackabilization/io/read.h"
#include "support/catch.h"
#include "support/differences.h"
#include "support/solids.h"

using namespace stackabilization;
using namespace stackabilization::apps;
using nlohmann::json;

namespace {

json deformed(const Arguments& arguments) {
  const Outcome outcome = run_program(joined({"deform"}, joined(arguments, {"--json", "-", "--no-timing"})));
  INFO(outcome.err);
  REQUIRE((outcome.status == 0 || outcome.status == 1));
  CHECK(outcome.err.empty());
  return outcome.json();
}

}  // namespace

TEST_CASE("an edit is made, the others follow, and the result says what became of relations and size") {
  const TableProject folder;
  const std::string output = folder / "wide.obj";
  const json document = deformed({folder.project, "--edit", "top scale 2 along 1 0 0", "-o", output});
  CHECK(document["command"] == "deform");
  CHECK(document["deformation"] == "controllers");
  CHECK(document["edits"] == json::array({"top scale 2 along 1 0 0"}));
  CHECK(document["refusal"].is_null());
  CHECK((vector_of(document["size_before"]) - Eigen::Vector3d(8, 8, 6)).norm() < 1e-9);
  CHECK(document["size_after"][0].get<double>() == Approx(16));
  CHECK(document["residuals"]["joint"].get<double>() < 1e-6);
  CHECK(document["residuals"]["symmetry"].get<double>() < 1e-6);
  CHECK(document["displacement"]["largest"].get<double>() >=
        document["displacement"]["root_mean_square"].get<double>());
  CHECK(document["relations"].size() > 4);
  CHECK(document["primitives"].size() == 5);
  const Shape after = read_shape(output);
  CHECK(range_along(after, Eigen::Vector3d::UnitX()).length() == Approx(16));
  CHECK(after.part_names == solids::table({}).part_names);
}

TEST_CASE("edits spread to symmetric parts, and a mesh is analysed on the way") {
  const TableProject folder;
  const std::string from_project = folder / "a.obj", from_mesh = folder / "b.obj";
  const std::string edit = "leg_1 scale 0.5 along 1 0 0";
  const json document = deformed({folder.project, "--edit", edit, "-o", from_project});
  CHECK(document["refusal"].is_null());
  deformed({folder.table, "--edit", edit, "-o", from_mesh});
  CHECK(bytes_of(from_project) == bytes_of(from_mesh));
  const Shape after = read_shape(from_project);
  for (const int leg : {1, 2, 3, 4})
    CHECK(range_along(extract_part(after, leg), Eigen::Vector3d::UnitX()).length() ==
          Approx(0.5).epsilon(1e-3));
}

TEST_CASE("an edit that changes nothing gives the mesh back") {
  const TableProject folder;
  const std::string output = folder / "same.obj";
  const std::vector<std::pair<std::string, std::string>> idle = {
      {"controllers", "top move 0 0 0"},
      {"surface", "shape move 0 0 0"},
      {"iwires", "shape move 0 0 0"},
      {"gap-scaling", "shape scale 1 along 0 0 1"}};
  for (const auto& [model, edit] : idle) {
    INFO(model);
    const json document = deformed({folder.project, "--model", model, "--edit", edit, "-o", output});
    CHECK(document["refusal"].is_null());
    CHECK(document["displacement"]["largest"].get<double>() < 1e-11);
    CHECK(largest_difference(read_shape(output).vertices, solids::table({}).vertices) < 1e-11);
  }
}

TEST_CASE("every model makes the edits it is for") {
  const TableProject folder;
  for (const std::string model : {"surface", "iwires", "gap-scaling"}) {
    INFO(model);
    const json document =
        deformed({folder.project, "--model", model, "--edit", "shape scale 0.5 along 0 0 1"});
    CHECK(document["deformation"] == model);
    CHECK((vector_of(document["size_after"]) - Eigen::Vector3d(8, 8, 3)).norm() < 1e-9);
    CHECK(document["residuals"]["joint"].get<double>() < 1e-9);
    CHECK(document["primitives"].empty());
  }
  const json sideways = deformed({folder.project, "--model", "gap-scaling", "--direction", "1", "0", "0",
                                  "--edit", "shape scale 0.5 along 1 0 0"});
  CHECK(sideways["size_after"][0].get<double>() == Approx(4));
}

TEST_CASE("what was written with z up is compared with a file in which y points up") {
  TableFolder folder;
  Shape lying = solids::table({});
  lying.vertices = (Points(lying.vertices.rows(), 3) << lying.vertices.col(0), lying.vertices.col(2),
                    -lying.vertices.col(1))
                       .finished();
  const std::string table = folder.model("lying.obj", lying), wider = folder / "wider.obj";
  deformed({table, "--up", "y", "--edit", "shape scale 1.05 along 1 0 0", "-o", wider});
  const auto compared = [&](const Arguments& options) {
    return run_program(joined({"compare", table, wider, "--up", "y", "--quiet"}, options)).status;
  };
  CHECK(compared({"--after-up", "z"}) == 0);
  CHECK(compared({}) == 1);
  CHECK(compared({"--after-up", "up"}) == 2);
}

TEST_CASE("edits are made in order, and a saved result is a new shape at rest") {
  const TableProject folder;
  const std::string both = folder / "both.obj", last = folder / "last.obj", middle = folder / "middle.json";
  const Arguments first = {"--edit", "top scale 2"}, second = {"--edit", "leg_1 scale 0.5"};
  deformed(joined({folder.project, "-o", both}, joined(first, second)));
  const json half = deformed(joined({folder.project, "--save", middle}, first));
  const json document = deformed(joined({middle, "-o", last}, second));
  CHECK(document["size_before"] == half["size_after"]);
  CHECK(largest_difference(read_shape(both).vertices, read_shape(last).vertices) < 1e-6);
}

TEST_CASE("what would break a wish is refused with 1, a reason, and nothing written") {
  const TableProject folder;
  const std::string output = folder / "never.obj", project = folder / "never.json";
  const std::vector<std::string> before = folder.names();
  const std::vector<Arguments> wishes = {{"--edit", "top scale 2", "--box-tolerance", "0.1"},
                                         {"--edit", "top move 1 0 0"},
                                         {"--edit", "top move 0 0 1", "--fix", "top"}};
  for (const Arguments& wish : wishes) {
    const Arguments arguments = joined({folder.project, "-o", output, "--save", project}, wish);
    const json document = deformed(arguments);
    REQUIRE(document["refusal"].is_object());
    CHECK(!document["refusal"]["reason"].get<std::string>().empty());
    CHECK(document["refusal"].contains("relation"));
    CHECK(document["refusal"]["amount"].get<double>() >= 0);
    const Outcome told = run_program(joined({"deform"}, arguments));
    CHECK(told.status == 1);
    CHECK(told.out.find("Refused: " + document["refusal"]["reason"].get<std::string>()) != std::string::npos);
    CHECK(told.err.empty());
    CHECK(run_program(joined({"deform", "--quiet"}, arguments)).out == "refused\n");
  }
  CHECK(folder.names() == before);
}

TEST_CASE("a refusal names the relation that would break, and by how much") {
  const TableProject folder;
  const json refusal = deformed({folder.project, "--edit", "top move 1 0 0"})["refusal"];
  REQUIRE(refusal["relation"].is_object());
  CHECK(refusal["relation"]["type"] == "self_symmetry");
  CHECK(refusal["relation"]["parts"] == json::array({"top"}));
  const json relations = run_program({"structure", folder.project, "--json", "-"}).json()["relations"];
  CHECK(relations.at(refusal["relation"]["index"].get<std::size_t>())["parts"] == json::array({"top"}));
  CHECK(refusal["amount"].get<double>() == Approx(1 / Eigen::Vector3d(8, 8, 6).norm()).epsilon(1e-3));
}

TEST_CASE("handles are listed with their centres, and all of them can be edited") {
  const TableProject folder;
  const json document = run_program({"deform", folder.project, "--list-handles", "--json", "-"}).json();
  std::vector<std::string> handles;
  for (const json& handle : document["handles"]) {
    handles.push_back(handle["handle"]);
    CHECK(vector_of(handle["centre"]).allFinite());
  }
  for (const char* name : {"top", "leg_3", "top/face=+z", "leg_1/corner=7"})
    CHECK(std::find(handles.begin(), handles.end(), name) != handles.end());
  const std::string text = run_program({"deform", folder.project, "--list-handles"}).out;
  for (const std::string& handle : handles) {
    CHECK(text.find(handle) != std::string::npos);
    CHECK(run_program({"deform", folder.project, "--edit", handle + " move 0 0 0", "--quiet"}).status == 0);
  }
}

TEST_CASE("extent, parts and points are kept when asked for") {
  const TableProject folder;
  const Arguments wider = {folder.project, "--edit", "top scale 2"};
  const json kept = deformed(joined(wider, {"--keep-extent", "0", "0", "1"}));
  CHECK(kept["refusal"].is_null());
  CHECK(kept["extent_before"].get<double>() == Approx(6));
  CHECK(kept["extent_after"].get<double>() == Approx(6).epsilon(1e-9));
  CHECK(deformed(wider)["size_after"][2].get<double>() > 6.1);

  // Without its foot held the table would be lifted as a whole.
  const std::string output = folder / "lifted.obj";
  deformed({folder.project, "--edit", "top move 0 0 1", "--fix-point", "0", "0", "0", "-o", output});
  CHECK((read_shape(output).vertices.row(8).transpose() - Eigen::Vector3d(0, 0, 0)).norm() < 1e-9);
  CHECK(range_along(read_shape(output), Eigen::Vector3d::UnitZ()).length() == Approx(7));
}

TEST_CASE("wrong uses of deform and structure end with 2 and name the mistake") {
  const TableProject folder;
  const std::string& project = folder.project;
  const std::vector<std::pair<Arguments, std::string>> cases = {
      {{"deform", project}, "expected --edit"},
      {{"deform", project, "--edit", "top shove 0 0 1"},
       "expected move, rotate, scale, taper or lean, found 'shove'"},
      {{"deform", project, "--edit", "lid move 0 0 1"}, "there is no part 'lid'"},
      {{"deform", project, "--edit", "top/face=up move 0 0 1"}, "'up'"},
      {{"deform", project, "--edit", "top/section=1 move 0 0 1"}, "section"},
      {{"deform", project, "--edit", "top scale 0"}, "positive"},
      {{"deform", project, "--edit", "top/face=+z scale 2 along 1 0 0"}, "along"},
      {{"deform", project, "--edit", "top move 0 0 1", "--fix", "lid"}, "'lid'"},
      {{"deform", project, "--edit", "top move 0 0 1", "--box-tolerance", "-1"}, "--box-tolerance"},
      {{"deform", project, "--edit", "top move 0 0 1", "--keep-extent", "0", "0", "0"}, "--keep-extent"},
      {{"deform", project, "--edit", "top move 0 0 1", "--extent-ends", "fixed"}, "--keep-extent"},
      {{"deform", project, "--edit", "top move 0 0 1", "--fix-point", "0", "0", "up"}, "'up'"},
      {{"deform", project, "--edit", "top move 0 0 1", "--fix-point", "0", "0"}, "--fix-point"},
      {{"deform", project, "--edit", "top move 0 0 1", "--model", "clay"}, "controllers|surface"},
      {{"deform", project, "--edit", "top move 0 0 1", "-o", project}, "replace the model"},
      {{"deform", project, "--edit", "top move 0 0 1", "--save", project}, "replace the model"},
      {{"deform", project, "--edit", "top move 0 0 1", "-o", folder / "a.doc"}, ".obj"},
      {{"deform", project, "--edit", "top move 0 0 1", "-o", folder / "a.obj", "--picture", folder / "a.png",
        "--json", folder / "a.png"},
       "same output"},
      {{"deform", project, "--edit", "top move 0 0 1", "--model", "surface", "--save", folder / "b.json"},
       "controllers"},
      {{"deform", project, "--edit", "top move 0 0 1", "--direction", "0", "0", "1"}, "--direction"},
      {{"deform", project, "--list-handles", "--edit", "top move 0 0 1"}, "--list-handles"},
      {{"deform", project, "--list-handles", "-o", folder / "a.obj"}, "--list-handles"},
      {{"deform", project, "--edit", "top move 0 0 1", "--sections", "9"}, "--sections"},
      {{"structure", project, "--segmentation", "given"}, "--segmentation"},
      {{"structure", folder.table, "--segmentation", "magic"}, "shape-diameter"},
      {{"structure", folder.table, "--segments", "0"}, "--segments"},
      {{"structure", folder.table, "--sections", "3"}, "from 4 to 1000"},
      {{"structure", folder.table, "--primitive", "top=sphere"}, "cuboid|cylinder"},
      {{"structure", folder.table, "--primitive", "top"}, "'top'"},
      {{"structure", folder.table, "--primitive", "lid=cuboid"}, "lid"},
      {{"structure", folder.table, "--symmetry-tolerance", "-1"}, "--symmetry-tolerance"},
      {{"structure", folder.table, "--joint-reach", "nan"}, "--joint-reach"},
      {{"structure", folder.table, "--graph", folder.table}, "replace the model"},
      {{"structure", folder.table, "--save", folder / "a.json", "--graph", folder / "a.json"}, "same output"},
      {{"structure", folder.table, "--seeds", project, "--save", project}, "replace the seeds"},
      {{"structure", folder.table, "--grp", project, "--json", project}, "replace the relations"},
      {{"structure", folder.table, "--ctrl", project, "--graph", project}, "replace the primitives"},
  };
  const std::string bytes = bytes_of(project);
  for (const auto& [arguments, words] : cases) check_refused(folder, arguments, 2, words);
  CHECK(bytes_of(project) == bytes);
}

TEST_CASE("projects that are damaged end with 3 and one sentence") {
  const TableProject folder;
  const std::string good = bytes_of(folder.project);
  for (std::size_t k = 1; k < 12; ++k) {
    const std::string project = folder.file("cut.json", good.substr(0, good.size() * k / 12));
    for (const Arguments& arguments :
         {Arguments{"structure", project}, Arguments{"deform", project, "--edit", "top move 0 0 0"}})
      check_refused(folder, arguments, 3, "cut.json");
  }
}
