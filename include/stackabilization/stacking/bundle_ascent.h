#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <functional>
#include <limits>

#include "stackabilization/stacking/direction_region.h"
#include "stackabilization/stacking/stackability.h"

namespace stackabilization {

/// Steps of a local search on the unit sphere.
struct AscentOptions {
  double first_step = 0;  ///< radius of the first trust region, radians, > 0
  double last_step = 0;   ///< ends below this radius, radians, > 0
  /// Asked before each step; true ends the climb at its current direction.
  std::function<bool()> cancelled = {};
  /// Limit of the number of directions tried, >= 0. The climb ends before a step that would exceed it.
  std::int64_t max_directions = std::numeric_limits<std::int64_t>::max();
};

/// Result of `climb`.
struct LocalOptimum {
  Stackability at;             ///< best direction found, with its S
  std::int64_t evaluated = 0;  ///< number of directions tried
};

/// Climbs from `start` to a local maximum of S within the region, by a bundle method (Schramm and Zowe 1992).
/// S is the minimum of many smooth functions, and its maxima are corners and ridges of this minimum. The
/// method approximates S by the minimum of planes, which it computes from values and difference quotients at
/// the start and at every trial. The next trial is the maximum of this model within a trust region. Only
/// values of S are used. Deterministic.
LocalOptimum bundle_ascent(const StackabilitySolver& solver, const DirectionRegion& region,
                           const Stackability& start, const AscentOptions& options);

}  // namespace stackabilization
