#pragma once

#include <Eigen/Core>
#include <vector>

namespace stackabilization {

/// Returns the signed area of the parallelogram a, b. It is positive when b is counter-clockwise of a.
inline double cross(const Eigen::Vector2d& a, const Eigen::Vector2d& b) {
  return a.x() * b.y() - a.y() * b.x();
}

/// Returns the columns of `points` (2 x n, n >= 1) that are the corners of their convex hull,
/// counter-clockwise from the lexicographically smallest corner. A corner closer than `resolution` to its
/// predecessor is omitted. A single point gives one column, a straight set two. Andrew's monotone chain, O(n
/// log n).
std::vector<int> convex_polygon(const Eigen::Matrix2Xd& points, double resolution);

/// A rectangle in the plane: `size.x()` along the unit vector `axis`, `size.y()` orthogonal to it.
struct PlanarRectangle {
  Eigen::Vector2d centre = Eigen::Vector2d::Zero();  ///< units of the points
  Eigen::Vector2d axis = Eigen::Vector2d::UnitX();   ///< unit
  Eigen::Vector2d size = Eigen::Vector2d::Zero();    ///< full lengths of the sides

  /// Returns the area, units of the points squared.
  double area() const { return size.prod(); }
};

/// Computes the rectangle of minimal area around a convex polygon (2 x m, counter-clockwise, m >= 1, distinct
/// corners). One side of the rectangle lies on a side of the polygon (Freeman and Shapira 1975). Rotating
/// calipers, O(m). Of equal areas the first polygon side wins.
PlanarRectangle minimal_rectangle(const Eigen::Matrix2Xd& polygon);

}  // namespace stackabilization
