#pragma once

#include <Eigen/Core>

#include "stackabilization/core/shape.h"
#include "stackabilization/mesh/boxes.h"

namespace stackabilization::detail {

/// A part in its own frame: the one of its box, longest axis first, each axis toward the side with the longer
/// tail, mirrored where that is left-handed.
struct CanonicalPose {
  Shape part;  ///< coordinates rounded to 2^-24 of the diagonal; turned inside out where mirrored, for it to
               ///< stay outward
  Eigen::Vector3d centre;
  Eigen::Matrix3d axes;  ///< columns, orthonormal: a point q of `part` is at centre + axes * q in the file
};

/// Copies of a part, moved, turned or mirrored, are equal bit for bit in this pose unless they are symmetric
/// themselves or rounding falls badly. Algorithms that amplify rounding then treat them alike.
CanonicalPose canonical_pose(const Shape& part, const OrientedBox& box);

}  // namespace stackabilization::detail
