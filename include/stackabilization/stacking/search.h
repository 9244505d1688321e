#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <functional>
#include <limits>
#include <optional>
#include <vector>

#include "stackabilization/stacking/direction_bound.h"
#include "stackabilization/stacking/direction_region.h"
#include "stackabilization/stacking/stackability.h"

namespace stackabilization {

/// Region, density and callbacks of `best_direction`.
struct SearchOptions {
  /// Restricts the search to this cone; default: the whole sphere.
  std::optional<DirectionCone> cone = {};
  /// Restricts the search to the plane through the origin with this normal; default: no restriction.
  std::optional<Eigen::Vector3d> plane_normal = {};
  /// Further directions, tried exactly as given, for instance normals of symmetry planes. The great circles
  /// orthogonal to them are searched too. Candidates outside cone and plane are ignored.
  std::vector<Eigen::Vector3d> candidates = {};
  /// Distance between samples, radians, in (0, 1].
  double spacing = 0.04;
  int climbs = 12;  ///< limit of the number of local maxima that are refined, >= 1
  /// Limit of the number of directions tried, those of the proof apart, >= 1. It bounds the work
  /// independently of the machine. Over the whole sphere, the spacing is increased until the even samples use
  /// half of it. Default: no limit.
  std::int64_t max_directions = std::numeric_limits<std::int64_t>::max();
  /// Proves the best direction to this accuracy of S, in (0, 1], by `stackability_bound`. Default: no proof.
  std::optional<double> certify = {};
  std::int64_t max_cells = DirectionBoundOptions{}.max_cells;  ///< limit of the cells of the proof, >= 1
  /// Called from the calling thread with the completed fraction in [0, 1].
  std::function<void(double)> progress = {};
  /// Asked from the calling thread, between batches of samples or cells and steps of a climb; true ends the
  /// search early.
  std::function<bool()> cancelled = {};
};

/// A local maximum of S. The direction has unit length, unless it is a candidate of the options;
/// DirectionRegion defines its sign.
struct DirectionOptimum {
  Eigen::Vector3d direction;  ///< r
  double stackability;        ///< S(M, r)
};

/// Result of `best_direction`.
struct SearchResult {
  Stackability best;      ///< S and its terms at the best direction
  Separation separation;  ///< exact f_max with witness at the best direction
  /// Distinct local maxima, best first; the first one is the best direction. The search looks only for maxima
  /// within about 0.05 of the best S.
  std::vector<DirectionOptimum> optima;
  std::optional<DirectionBound> bound;  ///< what no direction exceeds, where `certify` asks for it
  std::int64_t evaluated = 0;           ///< number of directions tried
  /// Number of these directions whose S is certainly too far below the best S for the start of a climb: by
  /// 0.2 at first, later by less. Most of them were abandoned before S was known.
  std::int64_t abandoned = 0;
  /// Whether the search used all of `max_directions`.
  bool limited = false;
  /// Whether the search ended early with the best direction so far.
  bool cancelled = false;
};

/// Searches the direction of largest S(M, r).
///
/// The search measures S at even samples, on great circles orthogonal to the main axes (probable symmetry
/// planes), and at candidates where S often has narrow peaks. Candidates are the axes of the cone, the file,
/// the box and the surface, the normals of large faces, and directions along pairs of such faces. A search in
/// a plane also tries the intersections with the planes orthogonal to these directions. The search climbs to
/// local maxima from the best distinct directions, and for the best maximum also along the discontinuities of
/// S. Without `certify` the result is not proven global: a peak much narrower than `spacing`, away from every
/// candidate, can be missed. The proof finds such a peak where it is higher than the accuracy.
///
/// Of directions equal to tolerance::stackability, the first one wins, in the order: axis of the cone,
/// candidates of the options, candidates of the shape. Deterministic for any number of threads. Throws
/// UsageError when an option is out of range, S is undefined, or cone and plane have no common direction, and
/// with `certify` where `stackability_bound` does.
/// Source: section 4.3 of the paper samples uniformly and takes the best sample.
SearchResult best_direction(const StackabilitySolver& solver, const SearchOptions& options = {});

}  // namespace stackabilization
