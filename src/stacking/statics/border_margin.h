#pragma once

#include <Eigen/Core>
#include <vector>

namespace stackabilization::detail {

/// Where the border of the convex hull of points in the plane is nearest to the origin.
struct BorderMargin {
  /// Distance of the border; negative where the origin is outside, 0 within `resolution` of it.
  double distance = 0;
  /// Unit vector away from the hull's inside at that place; zero for a point at the origin.
  Eigen::Vector2d outwards = Eigen::Vector2d::Zero();
  bool flat = false;  ///< whether the hull is a segment or a point
};

/// Finds the border that is nearest to the origin. Precondition: there are points. Lengths below `resolution`
/// are 0.
BorderMargin border_margin(const std::vector<Eigen::Vector2d>& points, double resolution);

}  // namespace stackabilization::detail
