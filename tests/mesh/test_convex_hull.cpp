#include <Eigen/LU>
#include <algorithm>
#include <numeric>
#include <random>
#include <vector>

#include "stackabilization/mesh/convex_hull.h"
#include "support/catch.h"

using namespace stackabilization;

namespace {

/// A grid of n x n x n points on integers from 0, sheared, so that no facet lies across an axis.
Points grid(int n) {
  Points points(n * n * n, 3);
  Eigen::Index row = 0;
  for (int x = 0; x < n; ++x)
    for (int y = 0; y < n; ++y)
      for (int z = 0; z < n; ++z) points.row(row++) << x + 2 * y, y + 3 * z, z - 4 * x;
  return points;
}

/// Corners of a prism over a convex octagon with integer corners, and the middles of its sides and facets.
Points prism() {
  const int octagon[8][2] = {{2, 0}, {4, 0}, {6, 2}, {6, 4}, {4, 6}, {2, 6}, {0, 4}, {0, 2}};
  std::vector<Eigen::RowVector3d> points;
  for (int k = 0; k < 8; ++k)
    for (const double share : {0.0, 0.5})
      for (const double z : {0.0, 4.0, 8.0}) {
        const auto &a = octagon[k], &b = octagon[(k + 1) % 8];
        points.emplace_back(a[0] + share * (b[0] - a[0]), a[1] + share * (b[1] - a[1]), z);
      }
  points.emplace_back(3, 3, 0);
  points.emplace_back(3, 3, 8);
  Points result(static_cast<Eigen::Index>(points.size()), 3);
  for (std::size_t k = 0; k < points.size(); ++k) result.row(static_cast<Eigen::Index>(k)) = points[k];
  return result;
}

Points shuffled(const Points& points, unsigned seed) {
  std::vector<int> rows(static_cast<std::size_t>(points.rows()));
  std::iota(rows.begin(), rows.end(), 0);
  std::shuffle(rows.begin(), rows.end(), std::mt19937(seed));
  return points(rows, Eigen::all);
}

double six_volumes(const TriangulatedHull& hull) {
  double sum = 0;
  for (const auto& t : hull.triangles.rowwise()) {
    Eigen::Matrix3d corners;
    for (int k = 0; k < 3; ++k) corners.row(k) = hull.points.row(t(k)) - hull.points.row(0);
    sum += corners.determinant();
  }
  return sum;
}

}  // namespace

TEST_CASE("a hull has its corners alone, whatever lies between them on its facets") {
  const TriangulatedHull cube = triangulated_hull(grid(4));
  CHECK(cube.points.rows() == 8);
  CHECK(cube.triangles.rows() == 12);
  CHECK(six_volumes(cube) == 6 * 27 * 23);  // 23: the determinant of the shear
  const TriangulatedHull column = triangulated_hull(prism());
  CHECK(column.points.rows() == 16);
  CHECK(column.triangles.rows() == 28);
  CHECK(six_volumes(column) == 6 * 28 * 8);
  for (Eigen::Index k = 0; k + 1 < column.points.rows(); ++k)
    CHECK(std::lexicographical_compare(column.points.row(k).begin(), column.points.row(k).end(),
                                       column.points.row(k + 1).begin(), column.points.row(k + 1).end()));
}

TEST_CASE("a hull does not depend on the order of the points, not even in how facets are cut") {
  for (const Points& points : {grid(3), grid(5), prism()}) {
    const TriangulatedHull hull = triangulated_hull(points);
    for (unsigned seed = 1; seed <= 12; ++seed) {
      const TriangulatedHull other = triangulated_hull(shuffled(points, seed));
      CHECK(other.points == hull.points);
      CHECK(other.triangles == hull.triangles);
    }
  }
}
