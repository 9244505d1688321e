#pragma once

#include <Eigen/Core>
#include <vector>

namespace stackabilization {

/// Signed area of the parallelogram a, b: positive when b lies counter-clockwise of a.
inline double cross(const Eigen::Vector2d& a, const Eigen::Vector2d& b) {
  return a.x() * b.y() - a.y() * b.x();
}

/// Columns of `points` (2 x n, n >= 1) that are the corners of their convex hull, counter-clockwise from the
/// lexicographically smallest. Corners closer than `resolution` to the one before are left out; one or two
/// columns come back for a point or a straight set. Andrew's monotone chain, O(n log n).
std::vector<int> convex_polygon(const Eigen::Matrix2Xd& points, double resolution);

/// A rectangle in the plane: `size.x()` along the unit vector `axis`, `size.y()` across it.
struct PlanarRectangle {
  Eigen::Vector2d centre = Eigen::Vector2d::Zero();  ///< units of the points
  Eigen::Vector2d axis = Eigen::Vector2d::UnitX();   ///< unit
  Eigen::Vector2d size = Eigen::Vector2d::Zero();    ///< full lengths of the sides

  double area() const { return size.prod(); }  ///< units of the points, squared
};

/// PlanarRectangle of minimal area around a convex polygon (2 x m, counter-clockwise, m >= 1, distinct
/// corners): one of its sides lies on a polygon side (Freeman and Shapira 1975). Rotating calipers, O(m);
/// among equals the first side wins.
PlanarRectangle minimal_rectangle(const Eigen::Matrix2Xd& polygon);

}  // namespace stackabilization
