#pragma once

#include <Eigen/Core>
#include <cstdint>

#include "stackabilization/stacking/direction_region.h"
#include "stackabilization/stacking/stackability.h"

namespace stackabilization::detail {

/// Largest number of directions that `circle_peak` measures.
constexpr std::int64_t max_circle_directions = 64;

/// Result of `circle_peak`.
struct CirclePeak {
  Stackability best;           ///< S is -infinity if the circle has no direction in the region
  std::int64_t evaluated = 0;  ///< directions measured
};

/// Returns the best direction of the circle `radius` (tangent of the angle) around `centre`: first of even
/// samples, then by bisection between the best two peaks and their neighbours. Along a discontinuity, only a
/// narrow part of the circle next to one of the two jumps is better than the centre.
CirclePeak circle_peak(const StackabilitySolver& solver, const DirectionRegion& region,
                       const Eigen::Vector3d& centre, double radius);

}  // namespace stackabilization::detail
