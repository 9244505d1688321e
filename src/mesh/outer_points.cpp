#include "mesh/outer_points.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cstddef>
#include <numeric>

#include "stackabilization/core/tolerances.h"
#include "stackabilization/mesh/convex_hull.h"

namespace stackabilization {

namespace {

/// Fewer points are not worth a second hull.
constexpr Eigen::Index few = 200;

/// The rows of the points that lie farthest along the 26 directions to the neighbours of a cell in a grid.
std::vector<Eigen::Index> outermost_rows(const Points& points) {
  std::vector<Eigen::Index> rows;
  for (int x = -1; x <= 1; ++x)
    for (int y = -1; y <= 1; ++y)
      for (int z = -1; z <= 1; ++z) {
        if (x == 0 && y == 0 && z == 0) continue;
        Eigen::Index row = 0;
        (points * Eigen::Vector3d(x, y, z)).maxCoeff(&row);
        rows.push_back(row);
      }
  std::sort(rows.begin(), rows.end());
  rows.erase(std::unique(rows.begin(), rows.end()), rows.end());
  return rows;
}

/// A plane of the inner hull: what is above `height` along `normal` is not inside.
struct Side {
  Eigen::RowVector3d normal;
  double height;
};

}  // namespace

std::vector<Eigen::Index> outer_points(const Points& points) {
  std::vector<Eigen::Index> rows(static_cast<std::size_t>(points.rows()));
  std::iota(rows.begin(), rows.end(), 0);
  if (points.rows() < few) return rows;
  const TriangulatedHull inner = triangulated_hull(points(outermost_rows(points), Eigen::all));
  if (inner.dimension < 3) return rows;
  const double margin =
      tolerance::relative * (inner.points.colwise().maxCoeff() - inner.points.colwise().minCoeff()).norm();
  std::vector<Side> sides;
  for (const auto& triangle : inner.triangles.rowwise()) {
    const Eigen::Vector3d a = inner.points.row(triangle(0)), b = inner.points.row(triangle(1)),
                          c = inner.points.row(triangle(2));
    const Eigen::Vector3d normal = (b - a).cross(c - a).stableNormalized();
    sides.push_back({normal.transpose(), normal.dot(a) - margin});
  }
  // Neighbours in the list are mostly neighbours in space, and outside of the same plane.
  std::size_t last = 0;
  const auto is_inside = [&](Eigen::Index row) {
    const auto is_below = [&](const Side& side) { return side.normal.dot(points.row(row)) < side.height; };
    if (!is_below(sides[last])) return false;
    for (std::size_t k = 0; k < sides.size(); ++k)
      if (!is_below(sides[k])) {
        last = k;
        return false;
      }
    return true;
  };
  std::erase_if(rows, is_inside);
  return rows;
}

}  // namespace stackabilization
