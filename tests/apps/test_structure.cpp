#include <Eigen/Geometry>
#include <algorithm>

#include "apps/table_folder.h"
#include "support/catch.h"
#include "support/solids.h"

using namespace stackabilization;
using namespace stackabilization::apps;
using nlohmann::json;

namespace {

json structure_of(const std::string& model, const Arguments& further = {}) {
  const Outcome outcome = run_program(joined({"structure", model, "--json", "-", "--no-timing"}, further));
  INFO(outcome.err);
  REQUIRE(outcome.status == 0);
  return outcome.json();
}

json relations_of(const json& document, const std::string& type) {
  json found = json::array();
  for (const json& relation : document["relations"])
    if (relation["type"] == type) found.push_back(relation);
  return found;
}

const json& primitive_of(const json& document, const std::string& part) {
  for (const json& primitive : document["primitives"])
    if (primitive["part"] == part) return primitive;
  throw std::runtime_error("no primitive of " + part);
}

}  // namespace

TEST_CASE("the structure of a table: five cuboids, mirrored legs, a joint on each") {
  const TableFolder folder;
  const json document = structure_of(folder.table);
  CHECK(document["command"] == "structure");
  REQUIRE(document["parts"].size() == 5);
  CHECK(document["parts"][0] == json({{"name", "top"}, {"triangles", 12}}));
  REQUIRE(document["primitives"].size() == 5);
  for (const json& primitive : document["primitives"]) {
    CHECK(primitive["kind"] == "cuboid");
    CHECK(primitive["corners"].size() == 8);
    CHECK(primitive["fit_errors"]["cuboid"].get<double>() < 1e-9);
    CHECK(primitive["note"].is_string());
  }
  CHECK(document["diagonal"].get<double>() == Approx(Eigen::Vector3d(8, 8, 6).norm()));
  CHECK(document["symmetries"].size() >= 2);
  const json pairs = relations_of(document, "symmetry");
  CHECK(pairs.size() >= 3);
  for (const json& pair : pairs) {
    CHECK(pair["parts"].size() == 2);
    CHECK(pair["residual"].get<double>() < 1e-6);
    if (!pair.contains("plane")) continue;
    CHECK(vector_of(pair["plane"]["normal"]).norm() == Approx(1));
    CHECK(pair["plane"]["point"].size() == 3);
  }
  std::vector<std::string> joined;
  for (const std::string type : {"point_joint", "line_joint"})
    for (const json& joint : relations_of(document, type)) {
      CHECK(joint["points"].size() == (type == "point_joint" ? 1 : 2));
      for (const json& name : joint["parts"])
        if (name != "top") joined.push_back(name);
    }
  std::sort(joined.begin(), joined.end());
  CHECK(joined == std::vector<std::string>{"leg_1", "leg_2", "leg_3", "leg_4"});
  CHECK(!relations_of(document, "self_symmetry").empty());
}

TEST_CASE("a body of revolution has an axis in the JSON") {
  const TemporaryFolder folder;
  const json document = structure_of(folder.model("cup.obj", solids::frustum_shell({})));
  CHECK(document["primitives"][0]["kind"] == "cylinder");
  CHECK(document["primitives"][0]["centres"].size() == document["primitives"][0]["radii"].size());
  CHECK(document["primitives"][0]["closed"] == false);
  const bool revolution =
      std::any_of(document["symmetries"].begin(), document["symmetries"].end(), [](const json& symmetry) {
        return symmetry.contains("axis") && symmetry["axis"]["order"] == "revolution" &&
               std::abs(vector_of(symmetry["axis"]["direction"]).z()) > 1 - 1e-9;
      });
  CHECK(revolution);
}

TEST_CASE("structure prints its tables, and the essential when quiet") {
  const TableFolder folder;
  const std::string out = run_program({"structure", folder.table}).out;
  for (const char* words :
       {"5 cuboids, 0 generalized cylinders", "leg_3", "cuboid fit", "symmetry", "residual"})
    CHECK(out.find(words) != std::string::npos);
  const json document = structure_of(folder.table);
  const Outcome quiet = run_program({"structure", folder.table, "--quiet"});
  CHECK(quiet.out == "5 " + std::to_string(document["symmetries"].size()) + " " +
                         std::to_string(document["relations"].size()) + "\n");
}

TEST_CASE("a project is read back as it was saved, without the mesh") {
  const TableFolder folder;
  const std::string project = folder / "table.json", again = folder / "again.json";
  REQUIRE(run_program({"structure", folder.table, "--save", project}).status == 0);
  const json direct = structure_of(folder.table);
  std::filesystem::remove(folder.table);
  const json read = structure_of(project, {"--save", again});
  CHECK(bytes_of(again) == bytes_of(project));
  for (const char* key : {"parts", "symmetries", "relations", "diagonal", "findings"}) {
    INFO(key);
    CHECK(read[key] == direct[key]);
  }
  // Boxes are kept by centre and axes, which rounds their corners.
  for (std::size_t part = 0; part < 5; ++part) {
    CHECK(read["primitives"][part]["fit_errors"] == direct["primitives"][part]["fit_errors"]);
    for (std::size_t corner = 0; corner < 8; ++corner)
      CHECK((vector_of(read["primitives"][part]["corners"][corner]) -
             vector_of(direct["primitives"][part]["corners"][corner]))
                .norm() < 1e-12);
  }
}

TEST_CASE("the kind of primitives is forced for one part or for all") {
  const TableFolder folder;
  const json one = structure_of(folder.table, {"--primitive", "leg_2=cylinder", "--sections", "7"});
  CHECK(primitive_of(one, "leg_2")["kind"] == "cylinder");
  CHECK(primitive_of(one, "leg_2")["centres"].size() == 7);
  CHECK(primitive_of(one, "top")["kind"] == "cuboid");
  const json all = structure_of(folder.table, {"--primitive", "all=cylinder", "--primitive", "top=cuboid"});
  CHECK(primitive_of(all, "top")["kind"] == "cuboid");
  CHECK(primitive_of(all, "leg_1")["kind"] == "cylinder");
}

TEST_CASE("parts come from the file, from seeds, or from the surface") {
  const TableFolder folder;
  const std::string seeds = folder.file("seeds.txt", "upper 0 1 2 3 4 5 6 7 8 9 10 11\nlower 12 24 36 48\n");
  const json seeded = structure_of(folder.table, {"--seeds", seeds});
  CHECK(seeded["parts"] ==
        json({{{"name", "upper"}, {"triangles", 12}}, {{"name", "lower"}, {"triangles", 48}}}));
  CHECK(structure_of(folder.table, {"--segmentation", "given"})["parts"].size() == 5);
  CHECK(
      structure_of(folder.model("ball.obj", solids::sphere(1, 2)), {"--segmentation", "components"})["parts"]
          .size() == 1);
}

TEST_CASE("the mesh is written with the parts that were found") {
  const TableFolder folder;
  const std::string out = folder / "parts.obj";
  const json parts = structure_of(folder.table, {"--segmentation", "components", "-o", out})["parts"];
  const json written =
      run_program({"structure", out, "--segmentation", "given", "--json", "-"}).json()["parts"];
  CHECK(written == parts);
}

TEST_CASE("the graph of the relations is written for Graphviz") {
  const TableFolder folder;
  const std::string graph = folder / "table.dot";
  REQUIRE(run_program({"structure", folder.table, "--graph", graph}).status == 0);
  const std::string text = bytes_of(graph);
  CHECK(text.find("graph") != std::string::npos);
  for (const char* name : {"top", "leg_1", "leg_4"}) CHECK(text.find(name) != std::string::npos);
}

TEST_CASE("what the authors wrote down by hand stands in for the analysis") {
  const TableFolder folder;
  const Outcome missing = run_program({"structure", folder.table, "--ctrl", folder / "none.ctrl"});
  CHECK(missing.status == 3);
  CHECK(missing.err.find("none.ctrl") != std::string::npos);
  const std::string group =
      folder.file("table.grp", "SYMMETRY 2 leg_1 leg_2\r\nPOINTJOINT 2 top leg_1 0 0 0\r\n");
  const json document = structure_of(folder.table, {"--grp", group});
  REQUIRE(document["relations"].size() == 2);
  CHECK(document["relations"][0]["type"] == "symmetry");
  CHECK(document["relations"][0]["parts"] == json::array({"leg_1", "leg_2"}));
  // Their frame has its origin at the centre of the box.
  CHECK((vector_of(document["relations"][1]["points"][0]) - Eigen::Vector3d(4, 4, 3)).norm() < 1e-9);
}
