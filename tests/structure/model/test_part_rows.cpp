#include <Eigen/Geometry>

#include "stackabilization/structure/part_rows.h"
#include "stackabilization/structure/tolerances.h"
#include "support/catch.h"
#include "support/structures.h"

using namespace stackabilization;

namespace {

using RowsOfParts = std::vector<std::vector<int>>;

Primitive box_at(const Eigen::Vector3d& centre, const Eigen::Vector3d& size = {1, 4, 0.5}) {
  OrientedBox box;
  box.centre = centre;
  box.half_extents = size / 2;
  return cuboid_of(box);
}

Structure structure_of(const std::vector<Primitive>& primitives) {
  Structure structure;
  Points all(0, 3);
  for (const Primitive& primitive : primitives) {
    structure.parts.push_back({"part " + std::to_string(structure.parts.size()), primitive, {}});
    const Points points = control_points(primitive);
    all.conservativeResize(all.rows() + points.rows(), 3);
    all.bottomRows(points.rows()) = points;
  }
  if (all.rows() > 0) structure.diagonal = (all.colwise().maxCoeff() - all.colwise().minCoeff()).norm();
  return structure;
}

RowsOfParts rows_of(const std::vector<Primitive>& primitives) {
  RowsOfParts found;
  for (const PartRow& row : find_part_rows(structure_of(primitives))) found.push_back(row.parts);
  return found;
}

/// Boxes at these places along x.
std::vector<Primitive> boxes(const std::vector<double>& places) {
  std::vector<Primitive> all;
  for (const double x : places) all.push_back(box_at({x, 0, 0}));
  return all;
}

}  // namespace

TEST_CASE("parts of one form at even steps are a row, in its order") {
  CHECK(rows_of(boxes({0, 2, 4})) == RowsOfParts{{0, 1, 2}});
  CHECK(rows_of(boxes({4, 0, 8, 2, 6})) == RowsOfParts{{1, 3, 0, 4, 2}});
  CHECK(rows_of(boxes({0, 2})).empty());
  CHECK(rows_of({}).empty());
}

TEST_CASE("uneven steps and other forms end a row") {
  CHECK(rows_of(boxes({0, 2, 5})).empty());
  CHECK(rows_of(boxes({0, 2, 4, 7, 10})) == RowsOfParts{{0, 1, 2}, {2, 3, 4}});
  std::vector<Primitive> mixed = boxes({0, 2, 4, 6});
  mixed[3] = box_at({6, 0, 0}, {1, 5, 0.5});
  CHECK(rows_of(mixed) == RowsOfParts{{0, 1, 2}});
  mixed[3] = structures::straight_cylinder({6, -2, 0}, {6, 2, 0}, 0.5, 5);
  CHECK(rows_of(mixed) == RowsOfParts{{0, 1, 2}});
}

TEST_CASE("a step a little off is even, more is not") {
  const auto is_row = [](double step, double off) {
    return !rows_of(boxes({0, step + off / 2, 2 * step})).empty();
  };
  const double diagonal = structure_of(boxes({0, 20, 40})).diagonal;
  CHECK(is_row(20, 0.9 * tolerance::row_evenness * diagonal));
  CHECK_FALSE(is_row(20, 1.1 * tolerance::row_evenness * diagonal));
  CHECK(is_row(0.1, 0.9 * tolerance::row_step * 0.1));
  CHECK_FALSE(is_row(0.1, 1.1 * tolerance::row_step * 0.1));
}

TEST_CASE("parts in one place are no row") {
  CHECK(rows_of(boxes({0, 0, 0})).empty());
}

TEST_CASE("rungs that get longer by even steps are a row") {
  std::vector<Primitive> rungs;
  for (int k = 0; k < 4; ++k)
    rungs.push_back(
        structures::straight_cylinder({-5 - 0.2 * k, 0, 3.0 * k}, {5 + 0.2 * k, 0, 3.0 * k}, 0.3, 8));
  CHECK(rows_of(rungs) == RowsOfParts{{0, 1, 2, 3}});
  rungs[3] = structures::straight_cylinder({-5, 0, 9}, {5, 0, 9}, 0.3, 8);
  CHECK(rows_of(rungs) == RowsOfParts{{0, 1, 2}});
}

TEST_CASE("radii change by even steps too") {
  const auto rods = [](double first, double second, double third) {
    std::vector<Primitive> all;
    for (const double radius : {first, second, third})
      all.push_back(structures::straight_cylinder({2.0 * static_cast<double>(all.size()), 0, 0},
                                                  {2.0 * static_cast<double>(all.size()), 0, 9}, radius, 8));
    return rows_of(all).size();
  };
  CHECK(rods(0.3, 0.3, 0.3) == 1);
  CHECK(rods(0.3, 0.4, 0.5) == 1);
  CHECK(rods(0.3, 0.6, 0.3) == 0);
}

TEST_CASE("a grid has rows along its two ways, not across") {
  std::vector<Primitive> grid;
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j) grid.push_back(box_at({2.0 * i, 2.0 * j, 0}, {1, 1, 1}));
  const RowsOfParts rows = rows_of(grid);
  CHECK(rows.size() == 6);
  for (const std::vector<int>& row : rows) CHECK((row[1] - row[0] == 1 || row[1] - row[0] == 3));
}

TEST_CASE("rows do not depend on pose and unit, and their control points correspond") {
  const Eigen::Isometry3d pose =
      Eigen::Translation3d(3, -7, 2) * Eigen::AngleAxisd(0.7, Eigen::Vector3d(1, 2, -2).normalized());
  for (const double unit : {0.001, 1.0, 1000.0}) {
    std::vector<Primitive> turned = boxes({0, 2, 4, 6});
    for (std::size_t k = 0; k < turned.size(); ++k) {
      auto& corners = std::get<Cuboid>(turned[k]).corners;
      for (Eigen::Index i = 0; i < 8; ++i)
        corners.row(i) = unit * (pose * Eigen::Vector3d(corners.row(i).transpose())).transpose();
    }
    std::get<Cuboid>(turned[2]).corners = std::get<Cuboid>(turned[2]).corners.colwise().reverse().eval();
    const std::vector<PartRow> rows = find_part_rows(structure_of(turned));
    REQUIRE(rows.size() == 1);
    CHECK(rows[0].parts == std::vector<int>{0, 1, 2, 3});
    const Points first = control_points(turned[0]);
    for (std::size_t k = 0; k < 4; ++k) {
      const Points points = control_points(turned[k]);
      for (Eigen::Index i = 0; i < 8; ++i) {
        const Eigen::Vector3d expected =
            (unit * 2.0 * static_cast<double>(k)) * (pose.linear() * Eigen::Vector3d::UnitX()) +
            first.row(i).transpose();
        CHECK((points.row(rows[0].control_points[k][static_cast<std::size_t>(i)]).transpose() - expected)
                  .norm() <= 1e-12 * unit);
      }
    }
  }
}

TEST_CASE("structures of very many parts are not searched for rows") {
  std::vector<Primitive> many(tolerance::max_parts_in_rows + 1, box_at({0, 0, 0}));
  for (std::size_t k = 0; k < many.size(); ++k) many[k] = box_at({2.0 * static_cast<double>(k), 0, 0});
  CHECK(rows_of(many).empty());
  many.pop_back();
  CHECK(rows_of(many).size() == 1);
}
