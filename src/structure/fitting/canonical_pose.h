#pragma once

#include <Eigen/Core>

#include "stackabilization/core/shape.h"
#include "stackabilization/mesh/boxes.h"

namespace stackabilization::detail {

/// A part in the frame of its box: longest axis first. Each axis points to the side with the longer tail of
/// the part. A left-handed frame mirrors the part.
struct CanonicalPose {
  /// The part in its own frame. Coordinates are rounded to 2^-24 of the diagonal. The triangles of a mirrored
  /// part are reversed, so that normals stay outward.
  Shape part;
  Eigen::Vector3d centre;  ///< origin of the frame, model units
  Eigen::Matrix3d axes;    ///< orthonormal columns: point q of `part` is at centre + axes * q in the file
};

/// Computes the canonical pose. Moved, rotated or mirrored copies of a part are equal bit for bit in this
/// pose, except when the part is symmetric or rounding is unfavourable. Algorithms that amplify rounding then
/// treat the copies alike.
CanonicalPose canonical_pose(const Shape& part, const OrientedBox& box);

}  // namespace stackabilization::detail
