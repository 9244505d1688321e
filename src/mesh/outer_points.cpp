#include "mesh/outer_points.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cstddef>
#include <numeric>
#include <utility>

#include "mesh/tolerances.h"
#include "stackabilization/mesh/convex_hull.h"

namespace stackabilization {

namespace {

/// Fewer points are not worth a second hull.
constexpr std::size_t few = 200;
/// More points are worth another inner hull, up to so many: each has the points that are farthest beyond the
/// faces of the one before.
constexpr std::size_t many = 20'000;
constexpr int max_hulls = 3;
/// Points whose heights above all faces are computed at a time, in single precision: they stay in the
/// processor's nearest caches.
constexpr Eigen::Index block_size = 64;
/// The points that lie farthest along the 26 directions to the neighbours of a cell in a grid.
Points outermost(const Points& points) {
  std::vector<Eigen::Index> rows;
  for (int x = -1; x <= 1; ++x)
    for (int y = -1; y <= 1; ++y)
      for (int z = -1; z <= 1; ++z) {
        if (x == 0 && y == 0 && z == 0) continue;
        Eigen::Index row = 0;
        (points * Eigen::Vector3d(x, y, z)).maxCoeff(&row);
        rows.push_back(row);
      }
  return points(rows, Eigen::all);
}

/// Maps the box of points to [-1, 1]^3.
struct UnitBox {
  Eigen::Vector3d centre, half;

  explicit UnitBox(const Points& points) {
    const Eigen::Vector3d low = points.colwise().minCoeff(), high = points.colwise().maxCoeff();
    centre = low / 2 + high / 2;
    half = high / 2 - low / 2;
  }
  Eigen::Vector3d operator()(const Eigen::RowVector3d& point) const {
    return (point.transpose() - centre).cwiseQuotient(half);
  }
};

/// Planes of the faces of a hull in that box, one per column: the outward normal, and minus the height.
using Planes = Eigen::Matrix<float, 4, Eigen::Dynamic>;

Planes planes_of(const TriangulatedHull& hull, const UnitBox& box) {
  Planes planes(4, hull.triangles.rows());
  for (Eigen::Index t = 0; t < planes.cols(); ++t) {
    const auto corner = [&](int c) { return box(hull.points.row(hull.triangles(t, c))); };
    const Eigen::Vector3d a = corner(0), normal = (corner(1) - a).cross(corner(2) - a).stableNormalized();
    planes.col(t) << normal.cast<float>(), static_cast<float>(-normal.dot(a));
  }
  return planes;
}

/// Leaves out the rows of points that are inside of a hull. Returns its corners and the points that are
/// farthest beyond its faces.
Points leave_out_inside(const Points& points, const TriangulatedHull& hull, std::vector<Eigen::Index>& rows) {
  const UnitBox box(points);
  const Planes planes = planes_of(hull, box);
  std::vector<Eigen::Index> outer, beyond(static_cast<std::size_t>(planes.cols()), -1);
  std::vector<float> farthest(beyond.size(), 0);
  Planes block(4, block_size);
  block.row(3).setOnes();
  Eigen::MatrixXf heights(planes.cols(), block_size);
  for (std::size_t begin = 0; begin < rows.size(); begin += block_size) {
    const Eigen::Index count = std::min(block_size, static_cast<Eigen::Index>(rows.size() - begin));
    const auto row = [&](Eigen::Index k) { return rows[begin + static_cast<std::size_t>(k)]; };
    for (Eigen::Index k = 0; k < count; ++k) block.col(k).head<3>() = box(points.row(row(k))).cast<float>();
    heights.noalias() = planes.transpose().lazyProduct(block);
    for (Eigen::Index k = 0; k < count; ++k) {
      Eigen::Index face = 0;
      const float height = heights.col(k).maxCoeff(&face);
      if (height < -tolerance::inside_hull) continue;
      outer.push_back(row(k));
      const auto f = static_cast<std::size_t>(face);
      if (height <= farthest[f]) continue;
      farthest[f] = height;
      beyond[f] = row(k);
    }
  }
  rows = std::move(outer);
  std::erase(beyond, -1);
  Points next(hull.points.rows() + static_cast<Eigen::Index>(beyond.size()), 3);
  next << hull.points, points(beyond, Eigen::all);
  return next;
}

}  // namespace

std::vector<Eigen::Index> outer_points(const Points& points) {
  std::vector<Eigen::Index> rows(static_cast<std::size_t>(points.rows()));
  std::iota(rows.begin(), rows.end(), 0);
  if (rows.size() < few) return rows;
  Points inner = outermost(points);
  for (int hulls = 0; hulls < max_hulls; ++hulls) {
    const TriangulatedHull hull = triangulated_hull(inner);
    if (hull.dimension < 3) break;
    inner = leave_out_inside(points, hull, rows);
    if (rows.size() < many) break;
  }
  return rows;
}

}  // namespace stackabilization
