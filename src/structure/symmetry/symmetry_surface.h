#pragma once

#include <Eigen/Core>

#include "mesh/surface_index.h"
#include "stackabilization/mesh/boxes.h"
#include "stackabilization/structure/symmetry.h"

namespace stackabilization::detail {

/// A surface prepared for symmetry detection in its own frame: the origin is the centroid of the area, and
/// the unit is the diagonal of the minimal oriented box. Results therefore do not depend on pose and size.
struct SymmetrySurface {
  Eigen::Vector3d centroid;  ///< centroid of the area, model units
  double diagonal;           ///< diagonal of the minimal box, model units; positive
  OrientedBox box;           ///< minimal, own frame
  Eigen::Matrix3d spread;    ///< second moments of the area divided by the area, own frame
  double area;               ///< model units squared
  /// Length that tolerances are fractions of, own frame: 1, or three times the middle extent of the box for
  /// slender shapes. Otherwise a bar would be symmetric in any plane along it.
  double scale;
  SurfaceIndex index;  ///< own frame
  /// Unit normals of the triangles; 0 for triangles without area.
  Points normals;
  SurfaceSamples dense, medium, sparse;  ///< samples of decreasing number, own frame
  /// At most some hundred vertices of triangles, own frame.
  Points corners;
};

/// Number of points for a verification or refinement.
enum class Effort {
  sparse,  ///< few points
  dense,   ///< all points
};

/// Prepares a surface with `samples` dense samples. Throws InputError when the surface has no area.
/// Precondition: `validate(shape)`.
SymmetrySurface symmetry_surface(const Shape& shape, int samples);

/// Converts a symmetry from the own frame of `surface` to model units.
Symmetry to_model(const SymmetrySurface& surface, const Symmetry& own);
/// Converts a symmetry from model units to the own frame of `surface`.
Symmetry to_own(const SymmetrySurface& surface, const Symmetry& model);

/// Returns the point of a plane or axis that is nearest to the origin.
Eigen::Vector3d foot(const Symmetry& symmetry);

}  // namespace stackabilization::detail
