#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <limits>

#include "stackabilization/core/errors.h"
#include "stackabilization/structure/analysis.h"
#include "stackabilization/structure/project_file.h"
#include "structure/model/nearest_box.h"
#include "support/catch.h"
#include "support/messages.h"
#include "support/solids.h"
#include "support/variants.h"

using namespace stackabilization;

namespace {

/// A table in an odd pose, its legs symmetric, with every kind of entry.
StructuredShape table_project() {
  StructuredShape result;
  result.shape = transformed(solids::table({}),
                             Eigen::AngleAxisd(0.3, Eigen::Vector3d(1, 2, 3).normalized()).toRotationMatrix(),
                             Eigen::Vector3d(0.1, -1e-3, 7e5));
  result.shape.unit = Unit::millimetre;
  result.shape.part_names[0] = "top \"\\\n\u00e4";
  Structure& structure = result.structure;
  structure.diagonal = 12;
  for (Eigen::Index k = 0; k < result.shape.part_count(); ++k) {
    const Shape part = extract_part(result.shape, k);
    structure.parts.push_back({result.shape.part_names[static_cast<std::size_t>(k)],
                               cuboid_of(minimal_oriented_box(HullSupport(part))),
                               {.cuboid_error = 1.0 / 3, .cylinder_error = {}, .note = "n"}});
  }
  GeneralizedCylinder ring;
  ring.closed = true;
  ring.centres = result.shape.vertices.topRows(5);
  ring.radii = Eigen::VectorXd::LinSpaced(5, 0.1, 0.7);
  ring.rotation = Eigen::AngleAxisd(1, Eigen::Vector3d::UnitY());
  structure.parts[1].primitive = ring;
  structure.parts[1].fit.cylinder_error = 0.1;
  std::get<Cuboid>(structure.parts[2].primitive).corners(3, 1) += 0.25;
  structure.symmetries = {{.point = {0.1, 0.2, 0.3}, .axis = Eigen::Vector3d(1, 1, 0).normalized()},
                          {.kind = SymmetryKind::rotation, .axis = Eigen::Vector3d::UnitZ(), .order = 5},
                          {.kind = SymmetryKind::revolution, .axis = Eigen::Vector3d::UnitZ()}};
  const Points line = result.shape.vertices.middleRows(3, 2);
  structure.relations = {
      {.type = RelationType::point_joint,
       .parts = {0, 1},
       .symmetry = {},
       .points = line.topRows(1),
       .residual = 1e-300},
      {.type = RelationType::line_joint, .parts = {3, 0}, .symmetry = {}, .points = line, .residual = 0.1}};
  return result;
}

/// Two boxes that are each other's mirror image.
StructuredShape pair_project() {
  StructuredShape result;
  result.shape = concatenate(solids::box({1, 0, 0}, {2, 1, 3}), solids::box({-2, 0, 0}, {-1, 1, 3}));
  result.shape.part_names = {"right", "left"};
  for (Eigen::Index k = 0; k < 2; ++k)
    result.structure.parts.push_back({result.shape.part_names[static_cast<std::size_t>(k)],
                                      cuboid_of(axis_aligned_box(extract_part(result.shape, k).vertices)),
                                      {}});
  result.structure.diagonal = std::sqrt(26.0);
  result.structure.relations = {
      {.type = RelationType::symmetry, .parts = {0, 1}, .symmetry = {}, .points = {}}};
  return result;
}

std::string replaced(std::string text, const std::string& from, const std::string& to) {
  const std::size_t at = text.find(from);
  INFO("looking for " << from << " in\n" << text);
  REQUIRE(at != std::string::npos);
  return text.replace(at, from.size(), to);
}

std::string refusal_of_project(const std::string& text) {
  return message_of<InputError>([&] { project_of_text(text, "p.json"); });
}

}  // namespace

TEST_CASE("a project reads back bit for bit, and is written again as the same text") {
  const StructuredShape project = table_project();
  const std::string text = project_text(project);
  const StructuredShape back = project_of_text(text, "p.json");
  CHECK(project_text(back) == text);

  CHECK(back.shape.vertices == project.shape.vertices);
  CHECK(back.shape.triangles == project.shape.triangles);
  CHECK(back.shape.triangle_part == project.shape.triangle_part);
  CHECK(back.shape.part_names == project.shape.part_names);
  CHECK(back.shape.unit == project.shape.unit);
  const Structure &was = project.structure, &is = back.structure;
  REQUIRE(is.parts.size() == was.parts.size());
  for (std::size_t k = 0; k < is.parts.size(); ++k) {
    const double largest = control_points(was.parts[k].primitive).cwiseAbs().maxCoeff();
    const double off = (control_points(is.parts[k].primitive) - control_points(was.parts[k].primitive))
                           .cwiseAbs()
                           .maxCoeff();
    CHECK(off <= (k == 1 || k == 2 ? 0 : 1e-14 * largest));  // curves and odd cuboids exactly
    CHECK(is.parts[k].fit.cuboid_error == was.parts[k].fit.cuboid_error);
    CHECK(is.parts[k].fit.cylinder_error == was.parts[k].fit.cylinder_error);
    CHECK(is.parts[k].fit.note == was.parts[k].fit.note);
  }
  const auto& ring = std::get<GeneralizedCylinder>(is.parts[1].primitive);
  CHECK(ring.closed);
  CHECK(ring.radii == std::get<GeneralizedCylinder>(was.parts[1].primitive).radii);
  CHECK(ring.rotation.coeffs() == std::get<GeneralizedCylinder>(was.parts[1].primitive).rotation.coeffs());
  REQUIRE(is.symmetries.size() == 3);
  for (std::size_t k = 0; k < 3; ++k) {
    CHECK(is.symmetries[k].kind == was.symmetries[k].kind);
    CHECK(is.symmetries[k].point == was.symmetries[k].point);
    CHECK(is.symmetries[k].axis == was.symmetries[k].axis);
  }
  CHECK(is.symmetries[1].order == 5);
  REQUIRE(is.relations.size() == 2);
  for (std::size_t k = 0; k < 2; ++k) {
    CHECK(is.relations[k].type == was.relations[k].type);
    CHECK(is.relations[k].parts == was.relations[k].parts);
    CHECK(is.relations[k].points == was.relations[k].points);
    CHECK(is.relations[k].residual == was.relations[k].residual);
  }
}

TEST_CASE("boxes in every pose are written as boxes, and the text is a fixed point") {
  solids::Random random(21);
  StructuredShape project = pair_project();
  project.structure.relations.clear();
  for (int round = 0; round < 200; ++round) {
    OrientedBox box;
    box.centre = std::pow(10, random.uniform(-3, 3)) * random.in_cube();
    box.axes = Eigen::AngleAxisd(random.uniform(-3, 3), random.on_sphere()).toRotationMatrix();
    box.half_extents =
        Eigen::Vector3d(random.uniform(), random.uniform(), round % 7 == 0 ? 1e-6 : random.uniform());
    project.structure.parts[0].primitive = cuboid_of(box);
    const std::string text = project_text(project);
    CHECK(text.find("half_axes") < text.find("left"));
    CHECK(project_text(project_of_text(text, "")) == text);
  }
}

TEST_CASE("a project goes through a file") {
  const std::filesystem::path path = std::filesystem::temp_directory_path() /
                                     ("project_" + std::to_string(getpid()) + std::string(project_suffix));
  write_project(pair_project(), path);
  CHECK(project_text(read_project(path)) == project_text(pair_project()));
  std::filesystem::remove(path);
  CHECK_THROWS_AS(read_project(path), InputError);
  CHECK_THROWS_AS(write_project(pair_project(), path / "nowhere" / "p.json"), OutputError);
}

TEST_CASE("a primitive edited by hand takes its counterpart along") {
  const std::string text =
      replaced(project_text(pair_project()), "\"centre\": [1.5, 0.5, 1.5]", "\"centre\": [1.7, 0.5, 1.5]");
  const StructuredShape edited = project_of_text(text, "p.json");
  const OrientedBox right = nearest_box(std::get<Cuboid>(edited.structure.parts[0].primitive));
  const OrientedBox left = nearest_box(std::get<Cuboid>(edited.structure.parts[1].primitive));
  CHECK(right.centre.x() == Approx(1.6).epsilon(1e-14));
  CHECK(left.centre.x() == Approx(-1.6).epsilon(1e-14));
}

TEST_CASE("damaged projects are refused with the place and what was expected") {
  const std::string text = project_text(pair_project());
  struct Damage {
    std::string from, to, message;
  };
  const std::vector<Damage> damages = {
      {"stackabilize project", "something",
       "p.json: /format: expected 'stackabilize project', found 'something'"},
      {"\"version\": 1", "\"version\": 2", "p.json: /version: expected an integer from 1 to 1, found 2"},
      {"\"unit\": \"unknown\"", "\"unit\": \"furlong\"",
       "/unit: expected 'unknown', 'um', 'mm', 'cm', 'm', 'in' or 'ft', found 'furlong'"},
      {"\"unit\": \"unknown\",", "", "p.json: /: the key 'unit' is missing"},
      {"\"relations\"", "\"relation\"", "/: there is no key 'relation' here, did you mean 'relations'?"},
      {"\"symmetries\": []", "\"symmetries\": 7", "/symmetries: expected a list, found 7"},
      {"\"name\": \"left\"", "\"name\": \"right\"",
       "/parts/1/name: expected part names that differ from each other"},
      {"\"name\": \"left\"", "\"name\": \"\"", "/parts/1/name: expected a name"},
      {"\"kind\": \"cuboid\"", "\"kind\": \"cubiod\"",
       "/parts/0/primitive/kind: expected 'cuboid' or 'cylinder', found 'cubiod', did you mean 'cuboid'?"},
      {"\"centre\": [1.5, 0.5, 1.5]", "\"centre\": [1.5, 0.5]",
       "/parts/0/primitive/centre: expected 3 numbers, found a list of 2"},
      {"[1.5, 0.5, 1.5]", "[1.5, 0.5, \"a\"]", "/parts/0/primitive/centre/2: expected a number, found 'a'"},
      {"[1.5, 0.5, 1.5]", "[1.5, 0.5, 1e70]",
       "/parts/0/primitive/centre/2: expected a number of magnitude at most 1e60"},
      {"[1.5, 0.5, 1.5]", "[1.5, 0.5, 1e999]",
       "p.json: expected JSON, found a number beyond the range of double"},
      {"\"half_axes\": [[0.5, 0, 0], ", "\"half_axes\": [",
       "/parts/0/primitive/half_axes: expected a list of 3, found a list of 2"},
      {"{\"kind\": \"cuboid\", \"centre\": [1.5, 0.5, 1.5], \"half_axes\": [[0.5, 0, 0], [0, 0.5, 0], [0, 0, "
       "1.5]]}",
       "{\"kind\": \"cylinder\", \"closed\": false, \"sections\": [[0, 0, 0, 1], [0, 0, 0, 1]]}",
       "/parts/0/primitive: the primitive of part 'right' has two neighbouring cross-sections at one place"},
      {"{\"kind\": \"cuboid\", \"centre\": [1.5, 0.5, 1.5], \"half_axes\": [[0.5, 0, 0], [0, 0.5, 0], [0, 0, "
       "1.5]]}",
       "{\"kind\": \"cylinder\", \"closed\": true, \"sections\": [[0, 0, 0, 1], [0, 0, 1, 1]]}",
       "/parts/0/primitive/sections: expected a list of at least 3 times 4 numbers, found a list of 2"},
      {"\"type\": \"symmetry\"", "\"type\": \"symetry\"",
       "/relations/0/type: expected 'symmetry', 'self_symmetry', 'point_joint' or 'line_joint', found "
       "'symetry', did you mean 'symmetry'?"},
      {"\"parts\": [\"right\", \"left\"]", "\"parts\": [\"right\", \"lift\"]",
       "/relations/0/parts/1: expected 'right' or 'left', found 'lift', did you mean 'left'?"},
      {"\"parts\": [\"right\", \"left\"]", "\"parts\": [\"right\"]",
       "/relations/0/parts: expected a list of 2, found a list of 1"},
      {"\"parts\": [\"right\", \"left\"]", "\"parts\": [\"left\", \"left\"]",
       "/relations/0/parts: expected two different parts"},
      {"\"axis\": [1, 0, 0]", "\"axis\": [0, 0, 0]",
       "/relations/0/symmetry/axis: expected an axis of length 1"},
      {"\"axis\": [1, 0, 0]", "\"axis\": [1e60, 0, 0]",
       "/relations/0/symmetry/axis: expected an axis of length 1"},
      {"\"axis\": [1, 0, 0]", "\"axis\": [null, 0, 0]",
       "/relations/0/symmetry/axis/0: expected a number, found null"},
      {"[0.5, 0, 0], [0, 0.5, 0]", "[0.5, 0, 0], [0, 0, 0]",
       "/parts/0/primitive: the primitive of part 'right' has no volume"},
      {"[0.5, 0, 0], [0, 0.5, 0]", "[0.5, 0, 0], [0.5, 0, 0]",
       "/parts/0/primitive: the primitive of part 'right' has no volume"},
      {"[0.5, 0, 0], [0, 0.5, 0]", "[0.5, 0, 0], [0, 1e400, 0]",
       "p.json: expected JSON, found a number beyond the range of double"},
      {"[0.5, 0, 0], [0, 0.5, 0]", "[0.5, 0, 0], [0, NaN, 0]", "p.json:"},
      {"{\"kind\": \"cuboid\", \"centre\": [1.5, 0.5, 1.5], \"half_axes\": [[0.5, 0, 0], [0, 0.5, 0], [0, 0, "
       "1.5]]}",
       "{\"kind\": \"cylinder\", \"closed\": false, \"rotation\": [2, 0, 0, 0], \"sections\": [[0, 0, 0, 1], "
       "[0, 0, 1, 1]]}",
       "/parts/0/primitive/rotation: expected a rotation of length 1"},
      {"{\"kind\": \"cuboid\", \"centre\": [1.5, 0.5, 1.5], \"half_axes\": [[0.5, 0, 0], [0, 0.5, 0], [0, 0, "
       "1.5]]}",
       "{\"kind\": \"cylinder\", \"closed\": false, \"sections\": [[0, 0, 0, -1], [0, 0, 1, 1]]}",
       "/parts/0/primitive: the primitive of part 'right' has a radius that is not positive"},
      {"\"kind\": \"reflection\"", "\"kind\": \"rotation\"",
       "/relations/0/symmetry: the key 'order' is missing"},
      {"\"type\": \"symmetry\"", "\"type\": \"point_joint\"",
       "/relations/0: there is no key 'symmetry' here"},
      {"\"residual\": 0", "\"residual\": -1",
       "/relations/0/residual: expected a number that is not negative, found -1"},
      {"[0, 2, 1, 0]", "[0, 2, 99, 0]", ": expected an integer from 0 to 15, found 99"},
      {"\"triangles\": [\n", "\"triangles\": [[0, 1, 2],\n",
       "/mesh/triangles/0: expected a list of 4, found a list of 3"},
      {"\"mesh\": {", "\"mesh\": {\"vertices\": [],",
       "p.json: the key 'vertices' occurs twice in one object"},
      {"\"mesh\": {", "\"mesh\": {{", "p.json:"},
  };
  for (const Damage& damage : damages) {
    const std::string message = refusal_of_project(replaced(text, damage.from, damage.to));
    INFO(message);
    CHECK(message.find(damage.message) != std::string::npos);
  }
  CHECK(refusal_of_project("").find("p.json:1: expected JSON") == 0);
  CHECK(refusal_of_project("{\n\n]").find("p.json:3: expected JSON") == 0);
  CHECK(refusal_of_project(std::string(100000, '[')).find("nested too deeply") != std::string::npos);
  CHECK(refusal_of_project("[]").find("expected an object, found a list of 0") != std::string::npos);
}

TEST_CASE("any cut and any flipped byte is read or refused, never worse") {
  const std::string text = project_text(pair_project());
  solids::Random random(77);
  int refused = 0;
  for (int round = 0; round < 600; ++round) {
    std::string damaged = text;
    if (round % 3 == 0)
      damaged.resize(random.below(text.size()));
    else
      damaged[random.below(text.size())] = static_cast<char>(random.below(256));
    refused += refusal_of_project(damaged) != "accepted";
  }
  CHECK(refused > 300);
}

TEST_CASE("contradicting relations and names that are no text are refused") {
  StructuredShape project = pair_project();
  project.structure.relations.push_back(project.structure.relations[0]);
  project.structure.relations[1].symmetry.point.x() = 0.5;
  CHECK(refusal_of_project(project_text(project))
            .find("p.json: relation 0 (symmetry of 'right' and 'left') and relation 1") == 0);
  project = pair_project();
  project.shape.part_names[0] = project.structure.parts[0].name = "\xff";
  CHECK_THROWS_AS(project_text(project), InputError);
  project = pair_project();
  project.structure.relations[0].parts = {0, 7};
  CHECK_THROWS_AS(project_text(project), InputError);
}
