#include <cmath>
#include <numbers>
#include <numeric>

#include "io/formats/triangulate.h"
#include "support/catch.h"
#include "support/meshes.h"
#include "support/variants.h"

using namespace stackabilization;
using namespace stackabilization::test;

namespace {

/// The polygon with corners in order, triangulated, as a shape.
Shape cut(const Points& corners) {
  std::vector<std::int32_t> polygon(static_cast<std::size_t>(corners.rows()));
  std::iota(polygon.begin(), polygon.end(), 0);
  const auto triangles = triangulate(corners, polygon);
  Triangles rows(static_cast<Eigen::Index>(triangles.size()), 3);
  for (std::size_t t = 0; t < triangles.size(); ++t)
    for (int i = 0; i < 3; ++i)
      rows(static_cast<Eigen::Index>(t), i) = triangles[t][static_cast<std::size_t>(i)];
  return make_shape(corners, rows);
}

/// Area vector of the polygon itself.
Eigen::Vector3d polygon_area(const Points& corners) {
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  for (Eigen::Index i = 0; i < corners.rows(); ++i) {
    const Eigen::Vector3d a = corners.row(i);
    const Eigen::Vector3d b = corners.row((i + 1) % corners.rows());
    sum += a.cross(b) / 2;
  }
  return sum;
}

/// For a planar simple polygon, areas add up exactly when no triangle flips or overlaps another.
void check_cut(const Points& corners) {
  const Shape shape = cut(corners);
  CHECK(shape.triangle_count() == corners.rows() - 2);
  const Eigen::Vector3d expected = polygon_area(corners);
  CHECK((area_vector(shape) - expected).norm() <= 1e-12 * expected.norm());
  CHECK(solids::surface_area(shape) == Approx(expected.norm()).epsilon(1e-12));
}

/// In every cyclic order of the corners, both ways round, and in a tilted plane.
void check_all_poses(const Points& corners) {
  const Eigen::Matrix3d tilt =
      Eigen::AngleAxisd(1.1, Eigen::Vector3d(1, 2, 3).normalized()).toRotationMatrix().transpose();
  Points turned = corners;
  for (Eigen::Index i = 0; i < corners.rows(); ++i) {
    const Points last = turned.bottomRows(1);
    turned.bottomRows(turned.rows() - 1) = Points(turned.topRows(turned.rows() - 1));
    turned.topRows(1) = last;
    check_cut(turned);
    check_cut(turned.colwise().reverse());
    check_cut(turned * tilt);
  }
}

Points polygon(std::initializer_list<Eigen::Vector2d> corners) {
  Points points(static_cast<Eigen::Index>(corners.size()), 3);
  Eigen::Index row = 0;
  for (const Eigen::Vector2d& corner : corners) points.row(row++) << corner.x(), corner.y(), 0;
  return points;
}

}  // namespace

TEST_CASE("Concave polygons are cut without flipping") {
  SECTION("arrow head") {
    check_all_poses(polygon({{0, 0}, {4, -2}, {1, 0}, {4, 2}}));
  }
  SECTION("L") {
    check_all_poses(polygon({{0, 0}, {3, 0}, {3, 1}, {1, 1}, {1, 3}, {0, 3}}));
  }
  SECTION("U with collinear corners") {
    check_all_poses(
        polygon({{0, 0}, {2, 0}, {5, 0}, {5, 4}, {4, 4}, {4, 1}, {2, 1}, {1, 1}, {1, 4}, {0, 4}, {0, 2}}));
  }
  SECTION("comb") {
    Points comb(21, 3);
    for (int tooth = 0; tooth < 19; ++tooth) comb.row(2 + tooth) << 19 - tooth, tooth % 2 ? 0.1 : 5.0, 0;
    comb.topRows(2) << 0, -1, 0, 20, -1, 0;
    check_all_poses(comb);
  }
  SECTION("star") {
    Points star(24, 3);
    for (int i = 0; i < 24; ++i) {
      const double angle = i * std::numbers::pi / 12;
      const double radius = i % 2 ? 1 : 3;
      star.row(i) << radius * std::cos(angle), radius * std::sin(angle), 0;
    }
    check_all_poses(star);
  }
  SECTION("a square hole reached by a bridge") {
    check_all_poses(
        polygon({{0, 0}, {4, 0}, {4, 4}, {0, 4}, {0, 0}, {1, 1}, {1, 3}, {3, 3}, {3, 1}, {1, 1}}));
  }
}

TEST_CASE("Convex polygons become fans from their first corner") {
  Points circle(6, 3);
  for (int i = 0; i < 6; ++i) circle.row(i) << std::cos(i), std::sin(i), 0.5 * std::sin(i);
  const Shape shape = cut(circle);
  for (Eigen::Index t = 0; t < shape.triangle_count(); ++t)
    CHECK(shape.triangles.row(t) == Eigen::RowVector3i(0, static_cast<int>(t) + 1, static_cast<int>(t) + 2));
}

TEST_CASE("Polygons without area and polygons that cross themselves keep their number of triangles") {
  CHECK(cut(polygon({{0, 0}, {1, 0}, {2, 0}, {3, 0}, {1, 0}})).triangle_count() == 3);
  CHECK(cut(polygon({{0, 0}, {1, 1}, {1, 0}, {0, 1}})).triangle_count() == 2);
  CHECK(cut(Points::Zero(6, 3)).triangle_count() == 4);
  Points pentagram(5, 3);
  for (int i = 0; i < 5; ++i)
    pentagram.row(i) << std::cos(4 * i * std::numbers::pi / 5), std::sin(4 * i * std::numbers::pi / 5), 0;
  CHECK(cut(pentagram).triangle_count() == 3);
}

TEST_CASE("The size of the coordinates does not matter") {
  const Points arrow = polygon({{0, 0}, {4, -2}, {1, 0}, {4, 2}});
  const Triangles expected = cut(arrow).triangles;
  for (const double scale : {1e-60, 1e-30, 1e30, 1e59}) CHECK(cut(arrow * scale).triangles == expected);
}
