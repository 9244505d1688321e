#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <functional>
#include <optional>

#include "stackabilization/stacking/direction_region.h"
#include "stackabilization/stacking/stackability.h"
#include "stackabilization/stacking/tolerances.h"

namespace stackabilization {

/// Region, accuracy and work of `stackability_bound`.
struct DirectionBoundOptions {
  std::optional<DirectionCone> cone = {};  ///< only directions of this cone; default: the whole sphere
  std::optional<Eigen::Vector3d> plane_normal = {};  ///< only directions in the plane with this normal
  /// Largest difference between the bound and the best S at which the bound is proven, in (0, 1].
  double accuracy = tolerance::direction_bound;
  std::int64_t max_cells = 200'000;           ///< limit of the cells examined, >= 1
  std::function<bool()> cancelled = {};       ///< asked from the calling thread; true ends the work early
  std::function<void(double)> progress = {};  ///< called from the calling thread with a fraction in [0, 1]
};

/// An upper bound of S over a region of directions.
struct DirectionBound {
  double bound = 1;        ///< no direction of the region has a larger S
  double accuracy = 0;     ///< that was asked for
  bool proven = false;     ///< bound - S of the best direction <= accuracy
  std::int64_t cells = 0;  ///< cells of directions that were examined
  std::int64_t open = 0;   ///< of these, cells that may hold an S above best + accuracy
  bool cancelled = false;  ///< whether the work was ended early
};

/// A bound, and the best direction that is known after the work for it.
struct BoundedStackability {
  DirectionBound bound;        ///< over all directions of the region
  Stackability best;           ///< the given one, or a better one that was met on the way
  std::int64_t evaluated = 0;  ///< directions whose S was measured
};

/// Computes an upper bound of S(M, r) over all directions r of a region, so that a direction that a search
/// found can be called the best one, within the accuracy.
///
/// Branch and bound over cells of the sphere. In a cell, S <= 1 - f A / V(M), where f is a lower bound of
/// f_max and A one of V(M, r) / h(M, r) over all directions of the cell. One pair of triangles that touches
/// along the four corners of a cell gives f: where it touches is a convex set (see docs/method.md). Bounds
/// are rounded outwards, so they hold for exact arithmetic and this V(M). Cells down to
/// tolerance::direction_cell are cut; a smaller one whose corners no pair of triangles has in common, at a
/// translation that is large enough, stays open. S of the best direction and the bound are then what is
/// known.
///
/// `best`: S at the best known direction, with its terms. Deterministic for any number of threads. Throws
/// UsageError for options out of range, S that is undefined, boxes other than `oriented`, and play above 0.
BoundedStackability stackability_bound(const StackabilitySolver& solver, const Stackability& best,
                                       const DirectionBoundOptions& options = {});

}  // namespace stackabilization
