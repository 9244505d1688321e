#pragma once

#include <Eigen/Geometry>
#include <vector>

#include "stackabilization/structure/symmetry_detection.h"
#include "structure/symmetry/symmetry_surface.h"

namespace stackabilization::detail {

/// Agreement of points with their expected positions.
struct Agreement {
  /// Root mean square of the smallest `SymmetryOptions::support` of the distances.
  double residual = 0;
  /// Share of the distances within three times the tolerance.
  double support = 0;
  bool holds = false;  ///< whether the distances are those of a symmetry
};

/// Decides whether distances between a surface and its image are those of a symmetry. `distances` are in the
/// unit of `options.tolerance`, and `diagonal` is the diagonal in that unit. Three conditions must hold:
///
/// * The smallest distances, of the share `options.support`, have at most the tolerance as root mean square
///   and lie within three times the tolerance.
/// * The other distances, averaged over all, add at most the tolerance again.
/// * All distances except outliers are below 0.4 (1 - `options.support`) of the diagonal, or below the
///   tolerance where that is more.
///
/// The last two conditions distinguish missing detail (a label, a button) from missing members (a leg, a
/// handle), which may have even less area.
Agreement agreement(std::vector<double> distances, double diagonal, const SymmetryOptions& options);

/// Computes the distances from the images of `points` under `map` to the surface.
std::vector<double> image_distances(const SurfaceIndex& index, const Points& points,
                                    const Eigen::Affine3d& map);

/// Decides whether `symmetry` (own frame) is a symmetry of the surface. The residual is a fraction of the
/// diagonal.
Agreement verify(const SymmetrySurface& surface, const Symmetry& symmetry, const SymmetryOptions& options,
                 Effort effort);

/// Returns the options for a symmetry before refinement.
SymmetryOptions loosen(const SymmetryOptions& options);

/// Returns the largest distance (own frame) between two points that count as counterparts.
double counterpart_reach(const SymmetrySurface& surface, const SymmetryOptions& options);

/// Throws UsageError unless the options are in their ranges.
void validate(const SymmetryOptions& options);

}  // namespace stackabilization::detail
