#pragma once

#include <Eigen/Core>

#include "stackabilization/core/shape.h"

namespace stackabilization::detail {

/// Where a set of points lies and how far it reaches, told from the surface of its convex hull: the number
/// and density of points do not matter.
struct PrincipalExtents {
  Eigen::Vector3d centre = Eigen::Vector3d::Zero();  ///< centroid of the hull's surface; of a flat hull's
                                                     ///< area; middle of a segment
  Eigen::Matrix3d axes =
      Eigen::Matrix3d::Identity();  ///< columns: principal axes of that surface, unit, largest moment first
  Eigen::Matrix<double, 3, 2> ranges =
      Eigen::Matrix<double, 3,
                    2>::Zero();  ///< per axis lowest and highest of axis . (p - centre), model units

  Eigen::Vector3d deviations =
      Eigen::Vector3d::Zero();  ///< per axis, root mean square over the surface, model units
  Points hull;                  ///< corners of the hull

  double length(int axis) const { return ranges(axis, 1) - ranges(axis, 0); }
};

/// Points count as flat, straight or single as in `hull_faces` with that `resolution` (model units).
/// Precondition: at least one point, all finite.
PrincipalExtents principal_extents(const Points& points, double resolution);

}  // namespace stackabilization::detail
