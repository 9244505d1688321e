#pragma once

#include "stackabilization/structure/primitive.h"

namespace stackabilization {

/// Returns the position to which a primitive carries `point` when it changes from `rest` to `now`. Cuboids
/// carry points by mean value coordinates (Ju et al. 2005). Generalized cylinders carry points by dual
/// quaternion skinning of their sections (Kavan et al. 2007), with radial offsets scaled by the radii. The
/// point may lie inside, on or outside of the primitive.
///
/// Exact up to rounding: `point` itself when nothing moved; affine maps of a cuboid; rigid motions and
/// uniform scalings of a generalized cylinder. Precondition: `rest` and `now` have the same kind and size.
Eigen::Vector3d deform_point(const Primitive& rest, const Primitive& now, const Eigen::Vector3d& point);

}  // namespace stackabilization
