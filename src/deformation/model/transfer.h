#pragma once

#include "stackabilization/structure/primitive.h"

namespace stackabilization {

/// Where a point goes that rides on a primitive, when the primitive goes from `rest` to `now`: by mean value
/// coordinates of the cuboid (Ju et al. 2005), by dual quaternion skinning (Kavan et al. 2007) of the
/// generalized cylinder's sections, radial offsets scaled with them. Inside, on and outside of the primitive.
///
/// Exact up to rounding: `point` itself when nothing moved; affine maps of a cuboid; rigid motions and
/// uniform scalings of a generalized cylinder. Precondition: both of the same kind and size.
Eigen::Vector3d carried(const Primitive& rest, const Primitive& now, const Eigen::Vector3d& point);

}  // namespace stackabilization
