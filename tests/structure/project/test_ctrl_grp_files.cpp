#include <algorithm>

#include "stackabilization/core/errors.h"
#include "stackabilization/structure/analysis.h"
#include "stackabilization/structure/ctrl_grp_files.h"
#include "structure/analysis/symmetrize.h"
#include "structure/model/nearest_box.h"
#include "support/catch.h"
#include "support/messages.h"
#include "support/solids.h"
#include "support/variants.h"

using namespace stackabilization;

namespace {

/// A plate on two posts, in a frame of its own: centre (5, -2, 3), half a diagonal of 3.
Shape gate() {
  Shape shape = solids::box({-2, -1, 1.5}, {2, 1, 2});
  shape = concatenate(shape, solids::box({-2, -1, -2}, {-1.5, 1, 1.5}));
  shape = concatenate(shape, solids::box({1.5, -1, -2}, {2, 1, 1.5}));
  shape.part_names = {"plate", "left", "right"};
  return solids::moved(shape, {5, -2, 3});
}

/// Lines as the authors' program writes them: CRLF, tabs, blanks at the end, exponents of three digits.
const std::string controls =
    "CUBOID\tleft\t-0.583333 0 -0.0833333\t1 0 0\t0 1 0\t0 0 "
    "1\t0.0833333\t0.333333\t0.583333\t1\t1\t1\t1\t1\t1\t1\t\r\n"
    "FOO bar\r\n"
    "GC\tright\t1.2\t16\t1.5\t3\t0.584 0 0.5\t0.583 0 -8.33e-002\t0.5835 0 "
    "-0.66667\t0.1\t0.1\t1.000000e-001\t\r\n";
const std::string groups =
    "POINTJOINT\t2\tplate\tleft\t-0.5833 0 0.5\t\r\n"
    "LINEJOINT\t2\tright\tplate\t0.5833 -0.3333 0.5\t0.5833 0.3333 0.5\r\n"
    "SELF_SYMMETRY\tplate\t2\t1 0 0\t0 1 0\t\r\n"
    "SELF_SYMMETRY\tright\t2\t-6.27744e+066 -6.27744e+066 -6.27744e+066\t8.9007e-308 8.9007e-308 "
    "8.9007e-308\t\r\n";

Structure structure_of(const std::string& control_text, const std::string& group_text) {
  return parse_ctrl_grp(gate(), {control_text, "a.ctrl"}, {group_text, "a.grp"});
}

std::string refusal_of_files(const std::string& control_text, const std::string& group_text) {
  return message_of<InputError>([&] { structure_of(control_text, group_text); });
}

}  // namespace

TEST_CASE("primitives and joints come back into the frame of the shape, parts that are missing are fitted") {
  const Structure structure = structure_of(controls, groups);
  REQUIRE(structure.parts.size() == 3);
  CHECK(structure.diagonal == Approx(6));
  const OrientedBox left = nearest_box(std::get<Cuboid>(structure.parts[1].primitive));
  CHECK((left.centre - Eigen::Vector3d(3.25, -2, 2.75)).norm() < 1e-5);
  CHECK((left.half_extents - Eigen::Vector3d(0.25, 1, 1.75)).norm() < 1e-5);
  CHECK(structure.parts[1].fit.cuboid_error < 1e-5);
  const auto& right = std::get<GeneralizedCylinder>(structure.parts[2].primitive);
  CHECK(right.radii.isApproxToConstant(0.3));
  CHECK(right.centres(0, 2) == Approx(4.5));
  CHECK(volume(structure.parts[0].primitive) == Approx(4 * 2 * 0.5));
  const auto& point = structure.relations[structure.relations.size() - 2];
  CHECK(point.type == RelationType::point_joint);
  CHECK((point.points - Eigen::RowVector3d(3.25, -2, 4.5)).norm() < 1e-3);
  const auto& line = structure.relations.back();
  CHECK(line.type == RelationType::line_joint);
  CHECK(line.parts == std::vector<int>{2, 0});
  CHECK((line.points.row(1) - Eigen::RowVector3d(6.75, -1, 4.5)).norm() < 1e-3);
}

TEST_CASE(
    "garbage normals of a cylinder count, nothing more: two make a body of revolution, symmetries come out "
    "exact") {
  const Structure structure = structure_of(controls, groups);
  int planes = 0, revolutions = 0;
  for (const Relation& relation : structure.relations) {
    if (relation.type != RelationType::self_symmetry) continue;
    CHECK(detail::symmetry_residual(structure, relation) < 1e-12);
    if (relation.parts[0] != 2) continue;
    planes += relation.symmetry.kind == SymmetryKind::reflection;
    revolutions += relation.symmetry.kind == SymmetryKind::revolution;
  }
  CHECK(planes == 2);
  CHECK(revolutions == 1);
}

TEST_CASE("a pair is mirrored midway, and older files without normals take the best planes of the box") {
  const std::string both =
      controls.substr(0, controls.find("FOO")) +
      "CUBOID right 0.58334 0 -0.0833333 1 0 0 0 1 0 0 0 1 0.0833333 0.333333 0.583333 1 1 1 1 1 1 1\n";
  const Structure structure = structure_of(both, "SYMMETRY\t2\tleft\tright\t\r\nSELF_SYMMETRY\tplate\t3\r\n");
  REQUIRE(structure.relations.size() == 4);
  for (const Relation& relation : structure.relations)
    CHECK(detail::symmetry_residual(structure, relation) < 1e-12);
  CHECK(structure.relations[0].symmetry.point.x() == Approx(5).epsilon(1e-4));
  CHECK(structure.relations[0].residual < 1e-4);
}

TEST_CASE("without files every part is fitted; a shape of one part is that part under any name") {
  CHECK(structure_of("", "").relations.empty());
  const Structure cup =
      parse_ctrl_grp(solids::cylinder(1, 4, 32), {"GC x 1 1 1 2 0 0 1 0 0 -1 0.4 0.4", "a.ctrl"},
                     {"SELF_SYMMETRY x 2", "a.grp"});
  CHECK(cup.relations.size() == 3);
  CHECK(std::holds_alternative<GeneralizedCylinder>(cup.parts[0].primitive));
}

TEST_CASE("damaged files are refused with file, line and what was expected") {
  struct Damage {
    std::string control, group, message;
  };
  const std::string cuboid = "CUBOID left 0 0 0 1 0 0 0 1 0 0 0 1 ";
  for (const Damage& damage : std::vector<Damage>{
           {"\nCUBOID lift 0 0 0", "", "a.ctrl:2: expected the name of a part of the shape, found 'lift'"},
           {"CUBOID", "", "a.ctrl:1: expected the name of a part"},
           {"CUBOID left 0 0", "", "a.ctrl:1: expected a centre, found the end of the line"},
           {"CUBOID left 0 0 x", "", "a.ctrl:1: expected a centre, found 'x'"},
           {"CUBOID left 0 0 1e999", "", "a.ctrl:1:"},
           {"CUBOID left 0 0 1e200", "", "a.ctrl:1: expected a centre of magnitude at most 1e6"},
           {"CUBOID left 0 0 0 2 0 0", "", "a.ctrl:1: expected an axis of length 1"},
           {cuboid + "1 -1 1", "", "a.ctrl:1: expected a half extent that is not negative"},
           {cuboid + "1 1 1 1 1 1", "", "a.ctrl:1: expected the scale of a face, found the end of the line"},
           {cuboid + "1 1 0 1 1 1 1 1 1 1", "", "a.ctrl:1: the primitive of part 'left' has no volume"},
           {"CUBOID left 0 0 0 1 0 0 1 0 0 0 0 1 1 1 1 1 1 1 1 1 1 1", "",
            "a.ctrl:1: the primitive of part 'left' has no volume"},
           {cuboid + "1 1 1 1 1 1 1 -1 1 1", "",
            "a.ctrl:1: expected the scale of a face that is not negative"},
           {cuboid + "nan 1 1 1 1 1 1 1 1 1", "", "a.ctrl:1: expected a half extent"},
           {"GC left 1 1 1 2 0 0 0 0 0 1 -1 1", "", "a.ctrl:1: expected a radius that is not negative"},
           {"GC left 1 1 1 1 0 0 0 1", "",
            "a.ctrl:1: expected a number of cross-sections that the line has room for, found 1"},
           {"GC left 1 1 1 9999999999 0 0 0 1", "", "has room for, found 9999999999"},
           {"GC left 1 1 1 2 0 0 0 0 0 0 1 1", "",
            "a.ctrl:1: the primitive of part 'left' has two neighbouring"},
           {"GC left 1 1 1 2 0 0 0 0 0 1 1 0", "",
            "a.ctrl:1: the primitive of part 'left' has a radius that is not positive"},
           {cuboid + "1 1 1 1 1 1 1 1 1 1\n" + cuboid + "1 1 1 1 1 1 1 1 1 1", "",
            "a.ctrl:2: part 'left' has a primitive already"},
           {"", "FOO 2 left right",
            "a.grp:1: expected SYMMETRY, SELF_SYMMETRY, POINTJOINT, JOINT or LINEJOINT, found 'FOO'"},
           {"", "SYMMETRY 3 left right plate", "a.grp:1: expected 2 parts"},
           {"", "SYMMETRY two left right", "a.grp:1: expected 2, the number of parts, found 'two'"},
           {"", "\r\nSYMMETRY 2 left top", "a.grp:2: expected the name of a part of the shape, found 'top'"},
           {"", "SYMMETRY 2 left left", "a.grp:1: expected two different parts"},
           {"", "POINTJOINT 2 left plate 1 2",
            "a.grp:1: expected a point of a joint, found the end of the line"},
           {"", "SELF_SYMMETRY left 9", "a.grp:1: expected one to three self-symmetries, found 9"},
           {"",
            "SYMMETRY 2 left right\nSELF_SYMMETRY left 1 1 0 0\nSELF_SYMMETRY right 1 0.6 0.8 0\nSYMMETRY 2 "
            "left plate",
            "a.grp: "},
       }) {
    const std::string message = refusal_of_files(damage.control, damage.group);
    INFO(message);
    CHECK(message.find(damage.message) != std::string::npos);
  }
}
