#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <functional>
#include <limits>

#include "stackabilization/stacking/direction_region.h"
#include "stackabilization/stacking/stackability.h"

namespace stackabilization {

/// How a local search moves: steps on the unit sphere, radians.
struct AscentOptions {
  double first_step = 0;                 ///< radius of the first trust region, radians, > 0
  double last_step = 0;                  ///< ends below this radius, radians, > 0
  std::function<bool()> cancelled = {};  ///< asked before each step; true ends the climb where it is
  /// Ends before a step that would try more directions than that in all, >= 0.
  std::int64_t max_directions = std::numeric_limits<std::int64_t>::max();
};

/// A direction with its S, and what it took to find it.
struct LocalOptimum {
  Stackability at;             ///< the best direction met, and S there
  std::int64_t evaluated = 0;  ///< directions tried
};

/// Climbs to a local maximum of S within the region. S is the least of many smooth functions, and its maxima
/// are corners and crests of theirs: the functions met nearby are kept as planes (values and difference
/// quotients, at the start and at every trial), and the maximum of the least of the planes within a trust
/// region is the next trial (bundle method, Schramm and Zowe 1992). Only values of S are used. Deterministic.
LocalOptimum bundle_ascent(const StackabilitySolver& solver, const DirectionRegion& region,
                           const Stackability& start, const AscentOptions& options);

}  // namespace stackabilization
