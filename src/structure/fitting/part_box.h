#pragma once

#include <Eigen/Core>
#include <array>

#include "stackabilization/mesh/boxes.h"
#include "structure/model/fit_error.h"

namespace stackabilization::detail {

/// First and second moments of a surface of constant mass per area.
struct SurfaceMoments {
  double area = 0;
  Eigen::Vector3d centre = Eigen::Vector3d::Zero();
  Eigen::Matrix3d covariance = Eigen::Matrix3d::Zero();  ///< mean of (p - centre) (p - centre)^T
};

/// Integrated triangle by triangle, without sampling: as symmetric as the part.
SurfaceMoments surface_moments(const Shape& part);

/// The cuboid's box of a part.
struct PartBox {
  OrientedBox box;         ///< every half extent at least `tolerance::min_thickness` of the diagonal, halved
  bool flat = false;       ///< without extent across some direction: no cylinder holds it
  bool thickened = false;  ///< some half extent was raised to the least one
};

/// The minimal oriented box, or another one that is as good to the eye and better placed: in this order the
/// box of the file's axes, boxes around the axis of inertia that stands out, boxes around an axis of the
/// minimal one, each turned as the file's axes demand; and the minimal one itself. As good: at most 5 % more
/// volume, and at most 20 % more root mean square distance from the surface. So round and square parts of a
/// model get boxes alike, and tapered ones symmetric boxes. Axes are ordered and signed to lie nearest to the
/// file's.
PartBox part_box(const FitSurface& part);

/// Columns of `box.axes`, longest first; of equally long ones (tolerance::relative) the later first.
std::array<int, 3> axes_by_length(const OrientedBox& box);

}  // namespace stackabilization::detail
