#pragma once

#include <Eigen/Core>

#include "stackabilization/core/shape.h"

namespace stackabilization::detail {

/// Position, principal axes and extents of a set of points, computed from the surface of its convex hull. The
/// number and the density of the points have no influence.
struct PrincipalExtents {
  /// Centroid of the surface of the hull, of the area of a flat hull, or the middle of a segment; model
  /// units.
  Eigen::Vector3d centre = Eigen::Vector3d::Zero();
  /// Columns: unit principal axes of that surface, largest moment first.
  Eigen::Matrix3d axes =
      Eigen::Matrix3d::Identity();  ///< columns: principal axes of that surface, unit, largest moment first
  /// Per axis, the lowest and the highest value of axis . (p - centre), model units.
  Eigen::Matrix<double, 3, 2> ranges =
      Eigen::Matrix<double, 3,
                    2>::Zero();  ///< per axis lowest and highest of axis . (p - centre), model units

  /// Per axis, the root mean square of axis . (p - centre) over the surface, model units.
  Eigen::Vector3d deviations =
      Eigen::Vector3d::Zero();  ///< per axis, root mean square over the surface, model units
  Points hull;                  ///< corners of the hull

  /// Returns the extent along an axis, model units.
  double length(int axis) const { return ranges(axis, 1) - ranges(axis, 0); }
};

/// Computes the spread of the points. `resolution` (model units) determines whether they are flat, straight
/// or a single point, as in `hull_faces`. Precondition: at least one point, all finite.
PrincipalExtents principal_extents(const Points& points, double resolution);

}  // namespace stackabilization::detail
