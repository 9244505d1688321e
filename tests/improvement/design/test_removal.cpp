#include <Eigen/Geometry>
#include <algorithm>
#include <filesystem>

#include "stackabilization/core/errors.h"
#include "stackabilization/improvement/removal.h"
#include "stackabilization/io/read.h"
#include "stackabilization/structure/analysis.h"
#include "support/catch.h"
#include "support/solids.h"
#include "support/structures.h"
#include "support/variants.h"

namespace stackabilization {
namespace {

std::vector<std::string> names_of(const StructuredShape& structured) {
  std::vector<std::string> names;
  for (const Part& part : structured.structure.parts) names.push_back(part.name);
  return names;
}

/// The table with its two mirror planes as global symmetries, too.
StructuredShape symmetric_table() {
  StructuredShape table = structures::table();
  Symmetry x, y;
  y.axis = Eigen::Vector3d::UnitY();
  table.structure.symmetries = {x, y};
  return table;
}

TEST_CASE("symmetric parts form classes") {
  const Structure table = structures::table().structure;
  CHECK(symmetric_classes(table) == std::vector<std::vector<int>>{{0}, {1, 2, 3, 4}, {5, 7}, {6, 8}});
  CHECK(symmetric_classes(Structure{}).empty());
}

TEST_CASE("what is left of a table has its own rows everywhere") {
  const StructuredShape table = symmetric_table();
  const StructuredShape rest = without_parts(table, {5, 0, 7, 5});
  CHECK_NOTHROW(validate(rest));
  CHECK_NOTHROW(validate(rest.shape));
  CHECK(names_of(rest) == std::vector<std::string>{"leg_1", "leg_2", "leg_3", "leg_4", "bar_2", "bar_4"});
  CHECK(rest.shape.part_names == names_of(rest));
  CHECK(rest.shape.triangle_count() == 6 * 12);
  CHECK(rest.shape.vertex_count() == 6 * 8);  // none that no triangle uses
  CHECK(rest.structure.diagonal == Approx(Eigen::Vector3d(7.8, 7.8, 5.5).norm()));
  CHECK(rest.structure.symmetries.size() == 2);
  for (std::size_t part = 0; part < 6; ++part) {
    const Shape alone = extract_part(rest.shape, static_cast<Eigen::Index>(part));
    const auto& corners = std::get<Cuboid>(rest.structure.parts[part].primitive).corners;
    CHECK(alone.vertices.colwise().minCoeff().isApprox(corners.colwise().minCoeff()));
    CHECK(alone.vertices.colwise().maxCoeff().isApprox(corners.colwise().maxCoeff()));
  }
  int pairs = 0, joints = 0;
  for (const Relation& relation : rest.structure.relations) {
    pairs += relation.type == RelationType::symmetry;
    joints += relation.type == RelationType::point_joint;
    if (relation.type != RelationType::symmetry) continue;
    const Points a =
        control_points(rest.structure.parts[static_cast<std::size_t>(relation.parts[0])].primitive);
    const Points b =
        control_points(rest.structure.parts[static_cast<std::size_t>(relation.parts[1])].primitive);
    const Eigen::RowVector3d image =
        (isometry_of(relation.symmetry) * a.colwise().mean().transpose()).transpose();
    CHECK((image - b.colwise().mean()).norm() < 1e-12);
  }
  CHECK(pairs == 5);
  CHECK(joints == 4);
}

TEST_CASE("residuals stay what they are in model units") {
  StructuredShape table = structures::table();
  for (Relation& relation : table.structure.relations) relation.residual = 0.01;
  const StructuredShape rest = without_parts(table, {0});
  for (const Relation& relation : rest.structure.relations)
    CHECK(relation.residual * rest.structure.diagonal == Approx(0.01 * table.structure.diagonal));
}

TEST_CASE("a global symmetry goes with the first of the parts that it swaps") {
  const StructuredShape table = symmetric_table();
  const StructuredShape without_leg = without_parts(table, {1});
  CHECK(without_leg.structure.symmetries.empty());
  const StructuredShape without_bar = without_parts(table, {5});  // on the plane x = 0
  REQUIRE(without_bar.structure.symmetries.size() == 1);
  CHECK(without_bar.structure.symmetries[0].axis == Eigen::Vector3d::UnitX());
}

TEST_CASE("removing nothing changes nothing") {
  const StructuredShape table = symmetric_table(), same = without_parts(table, {});
  CHECK(same.shape.vertices == table.shape.vertices);
  CHECK(same.shape.triangles == table.shape.triangles);
  CHECK(same.shape.triangle_part == table.shape.triangle_part);
  CHECK(same.structure.relations.size() == table.structure.relations.size());
  CHECK(same.structure.diagonal == Approx(table.structure.diagonal));
}

TEST_CASE("pieces hold all triangles and every relation that is not cut") {
  const StructuredShape table = structures::table();
  const std::vector<StructuredShape> pieces = split_into_groups(table, {{8, 7, 6, 5, 4, 3, 2, 1}, {0}});
  REQUIRE(pieces.size() == 2);
  CHECK(names_of(pieces[0])[0] == "leg_1");
  CHECK(names_of(pieces[1]) == std::vector<std::string>{"top"});
  CHECK(pieces[0].shape.triangle_count() + pieces[1].shape.triangle_count() == table.shape.triangle_count());
  CHECK(pieces[0].structure.relations.size() + pieces[1].structure.relations.size() + 4 ==
        table.structure.relations.size());
  for (const StructuredShape& piece : pieces) CHECK_NOTHROW(validate(piece));
}

TEST_CASE("removals and partitions refuse parts that do not exist or are not shared out") {
  const StructuredShape table = structures::table();
  CHECK_THROWS_AS(without_parts(table, {0, 1, 2, 3, 4, 5, 6, 7, 8}), UsageError);
  CHECK_THROWS_AS(without_parts(table, {9}), UsageError);
  CHECK_THROWS_AS(without_parts(table, {-1}), UsageError);
  CHECK_THROWS_AS(split_into_groups(table, {}), UsageError);
  CHECK_THROWS_AS(split_into_groups(table, {{0, 1, 2, 3, 4, 5, 6, 7, 8}, {}}), UsageError);
  CHECK_THROWS_AS(split_into_groups(table, {{0, 1, 2, 3, 4, 5, 6, 7}}), UsageError);
  CHECK_THROWS_AS(split_into_groups(table, {{0, 1, 2, 3, 4, 5, 6, 7}, {8, 0}}), UsageError);
  CHECK_THROWS_AS(split_into_groups(table, {{0, 1, 2, 3, 4, 5, 6, 7, 8, 9}}), UsageError);
  RemovalOptions nowhere;
  nowhere.directions.clear();
  CHECK_THROWS_AS(removals(table, nowhere), UsageError);
}

TEST_CASE("every removal is as good as the rest stacks") {
  const StructuredShape table = structures::table();
  RemovalOptions options;
  options.directions = {{0, 0, 1}, {1, 0, 1}};
  const std::vector<Removal> found = removals(table, options);
  CHECK(found.size() == 4);
  for (std::size_t k = 0; k < found.size(); ++k) {
    const Shape rest = without_parts(table, found[k].parts).shape;
    const double straight = stackability(rest, Direction(0, 0, 1)).value;
    const double slanted = stackability(rest, Direction(1, 0, 1)).value;
    CHECK(found[k].stackability == Approx(std::max(straight, slanted)));
    CHECK(found[k].direction == options.directions[slanted > straight ? 1 : 0]);
    CHECK(found[k].area == Approx(1 - solids::surface_area(rest) / solids::surface_area(table.shape)));
    if (k > 0) CHECK(found[k - 1].stackability >= found[k].stackability);
  }
  CHECK(removals(structures::box_alone({1, 2, 3})).empty());
}

TEST_CASE("of all removals, that of its back helps the swivel chair most") {
  const auto folder = std::filesystem::path(STACKABILIZATION_SOURCE_DIR) / "data" / "models";
  const StructuredShape chair = analyse_structure(read_shape(folder / "swivel_chair.obj"));
  const std::vector<Removal> found = removals(chair);
  REQUIRE(found.front().parts.size() == 1);
  CHECK(chair.structure.parts[static_cast<std::size_t>(found.front().parts[0])].name == "back");
  CHECK(stackability(chair.shape, Direction(0, 0, 1)).value < 0.03);
  CHECK(found.front().stackability > 0.3);
  CHECK(found[1].stackability < 0.1);
}

}  // namespace
}  // namespace stackabilization
