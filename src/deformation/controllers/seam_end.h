#pragma once

#include <Eigen/Core>

#include "stackabilization/core/shape.h"
#include "stackabilization/structure/primitive.h"

namespace stackabilization::detail {

/// How a part ends at a seam, the piece of the border that it shares with another part of one surface.
struct SeamEnd {
  /// How near to an end of the part the seam lies, from 0 in the middle to 1 at the end, times how much of
  /// the cross-section it takes up there: 1 for the upper end of a leg, nearly 0 for the seat that it
  /// carries.
  double share = 0;
  Eigen::Vector3d axis = Eigen::Vector3d::Zero();  ///< unit vector from there into the part, along the part
};

/// Computes how a part with these vertices ends at a seam. A cuboid ends along that of its axes that gives
/// the largest share, a generalized cylinder along its curve; a closed one has no ends. `vertices`: n x 3, n
/// >= 1; `seam`: m x 3, m >= 1; model units, at rest.
SeamEnd seam_end(const Primitive& primitive, const Points& vertices, const Points& seam);

}  // namespace stackabilization::detail
