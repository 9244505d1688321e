#pragma once

#include <Eigen/Core>
#include <array>

namespace stackabilization::detail {

using Segment = std::array<Eigen::Vector3d, 2>;
using Corners = std::array<Eigen::Vector3d, 3>;

/// Computes the point of a triangle nearest to `point` (Ericson 2005, section 5.1.5). Precondition: positive
/// area.
Eigen::Vector3d nearest_on_triangle(const Eigen::Vector3d& point, const Corners& triangle);

/// Closest approach of a segment to a triangle.
struct Approach {
  double distance = 0;  ///< smallest distance, model units
  /// Interval of the segment, in [0, 1], in which the distance is minimal up to `resolution`.
  double low = 0,
         high = 0;  ///< from here to there, in [0, 1] along the segment, it is as near, up to `resolution`
};

/// Computes the closest approach. `resolution`: model units. Precondition: a segment of positive length and a
/// triangle of positive area.
Approach approach(const Segment& segment, const Corners& triangle, double resolution);

}  // namespace stackabilization::detail
