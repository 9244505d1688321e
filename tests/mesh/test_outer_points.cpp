#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

#include "mesh/outer_points.h"
#include "stackabilization/mesh/convex_hull.h"
#include "support/catch.h"
#include "support/solids.h"
#include "support/variants.h"

using namespace stackabilization;

namespace {

/// Points of a ball, a cube, a box that stands aslant, and a ball that is mapped to a needle.
Points cloud(int kind, Eigen::Index count) {
  solids::Random random(static_cast<std::uint64_t>(kind + 1));
  const Eigen::Matrix3d turn =
      Eigen::AngleAxisd(0.7, Eigen::Vector3d(1, 2, 3).normalized()).toRotationMatrix();
  Points points(count, 3);
  for (Eigen::Index row = 0; row < count; ++row) {
    Eigen::Vector3d point = random.in_cube();
    if (kind == 0 || kind == 3) point *= std::cbrt(random.uniform(0, 1)) / point.norm();
    if (kind == 2) point = turn * Eigen::Vector3d(point.x(), 0.1 * point.y(), 0.2 * point.z());
    if (kind == 3) point = Eigen::Vector3d(1e3 + 100 * point.x(), 1e-3 * point.y(), 1e-3 * point.z());
    points.row(row) = point.transpose();
  }
  return points;
}

Points listed(const Points& points, const std::vector<Eigen::Index>& rows) {
  return points(rows, Eigen::all);
}

}  // namespace

TEST_CASE("The hull of the outer points is the hull of all, and few are left of a solid cloud") {
  const int kind = GENERATE(range(0, 4));
  const Points points = cloud(kind, 4000);
  const std::vector<Eigen::Index> rows = outer_points(points);
  CHECK(std::is_sorted(rows.begin(), rows.end()));
  CHECK(rows.size() < 3000);
  const TriangulatedHull all = triangulated_hull(points), outer = triangulated_hull(listed(points, rows));
  CHECK(outer.points == all.points);
  CHECK(outer.triangles == all.triangles);
}

TEST_CASE(
    "Many points are sifted by hulls within hulls, far from the origin too, and none of the hull is lost") {
  const int kind = GENERATE(range(0, 3));
  const Points points = cloud(kind, 60'000).rowwise() + Eigen::RowVector3d(3e4, -2e5, 1e3);
  const std::vector<Eigen::Index> rows = outer_points(points);
  CHECK(rows.size() < 30'000);
  const TriangulatedHull all = triangulated_hull(points), outer = triangulated_hull(listed(points, rows));
  CHECK(outer.points == all.points);
  CHECK(outer.triangles == all.triangles);
}

TEST_CASE("No point on the surface of a body is left out, however fine its mesh") {
  const Shape ball = solids::sphere(1, 4);
  CHECK(outer_points(ball.vertices).size() == static_cast<std::size_t>(ball.vertex_count()));
  // A cube cut finely: all of its points are on the hull, few of them corners.
  Shape cut = solids::box({0, 0, 0}, {1, 1, 1});
  for (int level = 0; level < 4; ++level) cut = solids::subdivided(cut);
  const Points cube = cut.vertices;
  REQUIRE(cube.rows() > 200);
  CHECK(outer_points(cube).size() == static_cast<std::size_t>(cube.rows()));
}

TEST_CASE("Few points, and flat ones, are all outer points") {
  CHECK(outer_points(cloud(0, 199)).size() == 199);
  Points flat = cloud(1, 1000);
  flat.col(2).setConstant(0.25);
  CHECK(outer_points(flat).size() == 1000);
  flat.col(1).setConstant(0.5);
  CHECK(outer_points(flat).size() == 1000);
  CHECK(outer_points(Points::Constant(1000, 3, 1.5)).size() == 1000);
}
