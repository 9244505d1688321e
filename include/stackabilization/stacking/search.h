#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <functional>
#include <limits>
#include <optional>
#include <vector>

#include "stackabilization/stacking/direction_region.h"
#include "stackabilization/stacking/stackability.h"

namespace stackabilization {

/// Where `best_direction` looks, how closely, and what watches it.
struct SearchOptions {
  /// Only look within this cone; default: the whole sphere.
  std::optional<DirectionCone> cone = {};
  /// Only look in the plane through the origin with this normal; default: everywhere.
  std::optional<Eigen::Vector3d> plane_normal = {};
  /// Further directions to try, exactly as given, for instance normals of symmetry planes; the great circles
  /// orthogonal to them are searched too. Those outside cone and plane are left out.
  std::vector<Eigen::Vector3d> candidates = {};
  double spacing = 0.04;  ///< radians between samples, in (0, 1]
  int climbs = 12;        ///< distinct local maxima that are refined at most, at least 1
  /// Directions tried at most, at least 1; a fixed amount of work whatever the machine. Over the whole sphere
  /// the spacing is widened until even samples take half of them. Default: no limit.
  std::int64_t max_directions = std::numeric_limits<std::int64_t>::max();
  /// Called with the fraction done, in [0, 1], from the calling thread.
  std::function<void(double)> progress = {};
  /// Asked from the calling thread, between batches of samples and steps of a climb; true ends the search
  /// early.
  std::function<bool()> cancelled = {};
};

/// A direction at which S has a local maximum: of unit length unless it is a candidate of the options, signed
/// as in DirectionRegion.
struct DirectionOptimum {
  Eigen::Vector3d direction;  ///< r
  double stackability;        ///< S(M, r)
};

/// What `best_direction` found.
struct SearchResult {
  Stackability best;      ///< S with its terms at the best direction
  Separation separation;  ///< exact f_max with witness at the best direction
  /// Distinct local maxima, best first; the first is the best direction. Only those within
  /// about 0.05 of it are looked for.
  std::vector<DirectionOptimum> optima;
  std::int64_t evaluated = 0;  ///< directions tried
  /// Of these left out because S is certainly too far below the best (0.2 at first, then ever less) to be the
  /// start of a climb, most of them before S was known.
  std::int64_t abandoned = 0;
  bool limited = false;    ///< all of `max_directions` were tried: the best of these
  bool cancelled = false;  ///< ended early: the best of what was seen
};

/// The direction of largest S(M, r): S is sampled evenly and on great circles orthogonal to the main axes,
/// where symmetry planes are likely, and at candidates where it often has narrow peaks (axes of cone, file,
/// box and surface, normals of large faces and directions along two of them; for a plane also where the
/// planes orthogonal to these meet it); from the best distinct ones it climbs to local maxima, the winner
/// along the cliffs of S too. Not proven global: a peak much narrower than `spacing` away from every
/// candidate can be missed.
///
/// Among directions equal to tolerance::stackability the earliest wins: the axis of the cone, candidates of
/// the options, then of the shape. Deterministic for any number of threads. Throws UsageError when an option
/// is out of range, S is undefined, or cone and plane have no direction in common. Source: section 4.3 of the
/// paper samples uniformly and takes the best sample.
SearchResult best_direction(const StackabilitySolver& solver, const SearchOptions& options = {});

}  // namespace stackabilization
