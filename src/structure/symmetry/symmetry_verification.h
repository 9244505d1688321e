#pragma once

#include <Eigen/Geometry>
#include <vector>

#include "stackabilization/structure/symmetry_detection.h"
#include "structure/symmetry/symmetry_surface.h"

namespace stackabilization::detail {

/// How far points are from where they should be.
struct Agreement {
  double residual = 0;  ///< root mean square of the smallest `SymmetryOptions::support` of the distances
  double support = 0;   ///< share of distances within three times the tolerance
  bool holds = false;
};

/// Do the distances, in the unit that `options.tolerance` is a fraction of, tell of a symmetry? So when: the
/// share `options.support` of them has at most the tolerance as root mean square and lies within three times
/// of it; the others, spread over all, add at most the tolerance again; and all but outliers stay below 0.4
/// (1 - `options.support`) of the diagonal, or below the tolerance where that is more. The last two tell
/// missing detail (a label, a button) from missing members (a leg, a handle), which may have even less area.
/// The diagonal is `diagonal` in that unit.
Agreement agreement(std::vector<double> distances, double diagonal, const SymmetryOptions& options);

/// Distances of the images of `points` under `map` from the surface.
std::vector<double> image_distances(const SurfaceIndex& index, const Points& points,
                                    const Eigen::Affine3d& map);

/// Is `symmetry` (own frame) one of the surface? Residual as a fraction of the diagonal.
Agreement verify(const SymmetrySurface& surface, const Symmetry& symmetry, const SymmetryOptions& options,
                 Effort effort);

/// What a symmetry that is not refined yet must satisfy.
SymmetryOptions loosen(const SymmetryOptions& options);

/// Up to this distance (own frame) two points count as counterparts.
double counterpart_reach(const SymmetrySurface& surface, const SymmetryOptions& options);

/// Throws UsageError unless the options lie in their ranges.
void validate(const SymmetryOptions& options);

}  // namespace stackabilization::detail
