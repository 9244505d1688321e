#pragma once

#include <Eigen/Core>
#include <array>

#include "stackabilization/core/direction.h"

namespace stackabilization::detail {

/// The directions through a rectangle on a face of the cube [-1, 1]^3: coordinate `axis` is 1, the next ones
/// (cyclic) are x and y. The three faces together hold every direction or its opposite.
struct DirectionCell {
  int axis = 2;  ///< in [0, 2]
  double x_low = -1, x_high = 1, y_low = -1, y_high = 1;

  /// Returns the direction through (x, y), of length 1 to sqrt(3).
  Eigen::Vector3d through(double x, double y) const;
  Eigen::Vector3d middle() const { return through(x_low / 2 + x_high / 2, y_low / 2 + y_high / 2); }
  /// Returns the directions through the corners, which span the cell.
  std::array<Eigen::Vector3d, 4> corners() const;
  /// Returns the largest angle between the middle and a direction of the cell, radians, rounded up.
  double radius() const;
  /// Returns the length of the shortest of the vectors `through(x, y)`, rounded down.
  double min_length() const;
  /// Returns two cells that together are this one, cut across its longer side.
  std::array<DirectionCell, 2> halves() const;
};

}  // namespace stackabilization::detail
