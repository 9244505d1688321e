#pragma once

#include <Eigen/Core>
#include <vector>

#include "stackabilization/shape/boxes.h"
#include "stackabilization/structure/surface_index.h"
#include "stackabilization/structure/symmetry.h"
#include "stackabilization/structure/symmetry_detection.h"

namespace stackabilization::detail {

/// A surface prepared for questions about its symmetries, in a frame of its own: origin in the area centroid,
/// unit the diagonal of the minimal oriented box, so that nothing depends on pose and size.
struct SymmetrySurface {
  Eigen::Vector3d centroid;  ///< of the area, model units
  double diagonal;           ///< of the minimal box, model units; positive
  OrientedBox box;           ///< minimal, own frame
  Eigen::Matrix3d spread;    ///< second moments of the area per area, own frame
  double area;               ///< model units squared
  /// What tolerances are fractions of, own frame: 1, but for slender shapes three times the middle extent of
  /// the box. A bar would otherwise be symmetric in any plane along it.
  double scale;
  SurfaceIndex index;                    ///< own frame
  Points normals;                        ///< unit, per triangle; 0 for those without area
  SurfaceSamples dense, medium, sparse;  ///< own frame
  Points corners;                        ///< vertices that triangles use, some hundreds at most; own frame
};

/// `samples` dense samples. Throws InputError when the surface has no area. Precondition: `validate(shape)`.
SymmetrySurface symmetry_surface(const Shape& shape, int samples);

/// From the own frame of `surface` to model units, and back.
Symmetry to_model(const SymmetrySurface& surface, const Symmetry& own);
Symmetry to_own(const SymmetrySurface& surface, const Symmetry& model);

/// The point of a plane or axis that is nearest to the origin.
Eigen::Vector3d foot(const Symmetry& symmetry);

/// How far points are from where they should be.
struct Agreement {
  double residual = 0;  ///< root mean square of the smallest `SymmetryOptions::support` of the distances
  double support = 0;   ///< share of distances within three times the tolerance
  bool holds = false;
};

/// Do the distances, in the unit that `options.tolerance` is a fraction of, tell of a symmetry? So when: the
/// share `options.support` of them has at most the tolerance as root mean square and lies within three times
/// of it; the others, spread over all, add at most the tolerance again; and all but outliers stay below 0.4
/// (1 - `options.support`) of the diagonal. The last two tell missing detail (a label, a button) from missing
/// members (a leg, a handle), which may have even less area. The diagonal is `diagonal` in that unit.
Agreement agreement(std::vector<double> distances, double diagonal, const SymmetryOptions& options);

/// Distances of the images of `points` under `map` from the surface.
std::vector<double> image_distances(const SurfaceIndex& index, const Points& points,
                                    const Eigen::Affine3d& map);

enum class Effort {
  sparse,  ///< few points
  dense,   ///< all points
};

/// Is `symmetry` (own frame) one of the surface? Residual as a fraction of the diagonal.
Agreement verify(const SymmetrySurface& surface, const Symmetry& symmetry, const SymmetryOptions& options,
                 Effort effort);

/// What may be called a surface of revolution.
enum class Roundness {
  /// It agrees with itself turned by any angle, without any detail that stands out.
  tolerant,
  /// And facets, where it faces sideways, stand out by less than one and a half tolerances of its radius:
  /// regular prisms of
  /// 14 sides and more are round, of 12 and less are not.
  faceted,
};

/// All axes (own frame) of revolution through, or near, the centroid; three for a sphere.
std::vector<Symmetry> revolutions(const SymmetrySurface& surface, const SymmetryOptions& options,
                                  Roundness roundness);

/// What a symmetry that is not refined yet must satisfy.
SymmetryOptions loosened(const SymmetryOptions& options);

/// Up to this distance (own frame) two points count as counterparts.
double counterpart_reach(const SymmetrySurface& surface, const SymmetryOptions& options);

/// Throws UsageError unless the options lie in their ranges.
void validate(const SymmetryOptions& options);

}  // namespace stackabilization::detail
