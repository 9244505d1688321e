#pragma once

#include <Eigen/Core>

#include "mesh/surface_index.h"
#include "stackabilization/mesh/boxes.h"
#include "stackabilization/structure/symmetry.h"

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

/// Which points of a surface a question is asked with.
enum class Effort {
  sparse,  ///< few points
  dense,   ///< all points
};

/// `samples` dense samples. Throws InputError when the surface has no area. Precondition: `validate(shape)`.
SymmetrySurface symmetry_surface(const Shape& shape, int samples);

/// From the own frame of `surface` to model units, and back.
Symmetry to_model(const SymmetrySurface& surface, const Symmetry& own);
Symmetry to_own(const SymmetrySurface& surface, const Symmetry& model);

/// The point of a plane or axis that is nearest to the origin.
Eigen::Vector3d foot(const Symmetry& symmetry);

}  // namespace stackabilization::detail
