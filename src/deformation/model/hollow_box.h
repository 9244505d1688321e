#pragma once

#include <Eigen/Core>
#include <vector>

#include "stackabilization/structure/primitive.h"

namespace stackabilization::detail {

/// A point bound to a hollow box.
struct HollowBoxBinding {
  Eigen::Vector3d point;  ///< position at rest
  /// Offset from the places that move the point: within a wall, from its outer side.
  Eigen::Vector3d offset;
  /// Per axis of the box, the mean value coordinates of the place that moves the point along this axis, in
  /// the order of Cuboid::corners.
  Eigen::Matrix<double, 8, 3> weights;
};

/// Returns whether a cuboid has walls.
bool is_hollow(const Cuboid& cuboid);

/// The motion of a hollow box since rest.
struct HollowBoxMotion {
  Eigen::Matrix<double, 8, 3> corners;  ///< now, relative to the centre at rest
  Eigen::Matrix3d rotation, stretch;    ///< the affine map that fits the corners best is rotation * stretch
  Eigen::Matrix3d axes;                 ///< of the box, rotated; unit columns
};

/// A box with walls (Cuboid::inner_sides) at rest, to which points are bound. Along the axis across a wall
/// its points move like its outer side, so that it keeps its thickness, and points between two walls move in
/// proportion; along the other axes all follow the corners by mean value coordinates. Rigid motions of the
/// corners move all points alike. Immutable, safe to share between threads.
class HollowBoxAtRest {
 public:
  /// Precondition: `rest` is a box.
  explicit HollowBoxAtRest(const Cuboid& rest);

  /// Returns the bindings of n points at rest, model units. They equal those of the points one by one.
  std::vector<HollowBoxBinding> bind(const Points& points) const;
  HollowBoxMotion motion(const Cuboid& now) const;  ///< the motion that takes the box to `now`
  /// Returns the position of a bound point after a motion.
  Eigen::Vector3d position_of(const HollowBoxBinding& binding, const HollowBoxMotion& motion) const;
  /// Computes the derivative of the position by corner `corner`.
  Eigen::Matrix3d derivative(const HollowBoxBinding& binding, const HollowBoxMotion& motion,
                             int corner) const;

 private:
  Cuboid rest_;
  Eigen::Vector3d centre_, half_extents_;
  Eigen::Matrix3d axes_;                  ///< unit columns
  Eigen::Matrix<double, 8, 3> gradient_;  ///< the affine map that fits corners best is corners^T * gradient
};

}  // namespace stackabilization::detail
