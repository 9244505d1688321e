#pragma once

#include <Eigen/Core>

#include "stackabilization/core/shape.h"
#include "stackabilization/mesh/boxes.h"

namespace stackabilization::detail {

/// A part in the frame of its box: longest axis first. Each axis points to the side with the longer tail of
/// the part. A left-handed frame mirrors the part.
struct CanonicalPose {
  /// The part in its own frame, with the diagonal of its box as unit. Coordinates are multiples of 2^-24. The
  /// triangles of a mirrored part are reversed, so that normals stay outward.
  Shape part;
  Eigen::Vector3d centre;  ///< origin of the frame, model units
  Eigen::Matrix3d axes;    ///< orthonormal columns
  double diagonal = 1;     ///< of the box, model units

  /// Returns points of the frame as points of the file, one per row.
  Points to_model(const Points& points) const {
    return (diagonal * points * axes.transpose()).rowwise() + centre.transpose();
  }
};

/// Computes the canonical pose. Moved, rotated, mirrored or scaled copies of a part are equal bit for bit in
/// this pose, except when the part is symmetric or rounding is unfavourable. Algorithms that amplify
/// rounding, or that have lengths of their own, then treat the copies alike.
/// Precondition: the box has a positive diagonal.
CanonicalPose canonical_pose(const Shape& part, const OrientedBox& box);

}  // namespace stackabilization::detail
