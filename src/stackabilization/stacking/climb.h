#pragma once

#include <Eigen/Core>
#include <cstdint>

#include "stackabilization/stacking/direction_region.h"
#include "stackabilization/stacking/stackability.h"

namespace stackabilization {

/// How a local search moves. Angles in radians.
struct ClimbOptions {
  double first_step = 0;
  double last_step = 0;
  /// Follow crests at which S falls off steeply on both sides: dearer, and needed near the end only.
  bool follow_crests = false;
};

/// Where a climb stands, and what it took.
struct Climb {
  Stackability at;
  Eigen::Vector3d circle_normal = Eigen::Vector3d::Zero();  ///< also step along this great circle, unless zero
  std::int64_t evaluated = 0;                               ///< directions tried
  std::int64_t abandoned = 0;                               ///< of these given up early
};

/// Climbs to a local maximum of S within the region, from `start.at`. S is not smooth: its maxima are corners and
/// crests, so only values are used. Polling on circles of shrinking radius around the best direction (mesh adaptive
/// direct search, Audet and Dennis 2006), turned by the golden angle each time; on crests the best direction of the
/// circle is found by golden section. Deterministic.
Climb climb(const StackabilitySolver& solver, const DirectionRegion& region, const Climb& start,
            const ClimbOptions& options);

}  // namespace stackabilization
