#pragma once

#include <Eigen/Core>

#include "stackabilization/core/shape.h"

namespace stackabilization::detail {

/// An affine map p -> linear (p - from) + to.
struct AffineMap {
  Eigen::Matrix3d linear = Eigen::Matrix3d::Identity();
  Eigen::Vector3d from = Eigen::Vector3d::Zero();
  Eigen::Vector3d to = Eigen::Vector3d::Zero();

  Eigen::Vector3d operator()(const Eigen::Vector3d& p) const { return linear * (p - from) + to; }
};

/// Fits the affine map of some points in the least-squares sense. Along directions in which the points have
/// no extent (a flat or straight part) it stretches by 1 and keeps them orthogonal to the others. What
/// becomes of the thin direction of a plate is told by points on both sides of it and not by how the plate
/// itself changes: changes that are quadratic along the plate, as those of a taper, do not turn it.
class AffineFit {
 public:
  /// Prepares the fit for the points at rest, one per row. Precondition: there is a point.
  explicit AffineFit(const Points& rest);

  /// Returns the map of `now`, the same points elsewhere.
  AffineMap map(const Points& now) const;
  /// Returns the linear part of a map of a plate without what its faces slide along each other: its thin
  /// direction goes to the normal of the plate. How faces slide depends on how they are cut into triangles,
  /// and is seen at the edges only. That of other parts is returned as it is.
  Eigen::Matrix3d without_slide(const AffineMap& map) const;
  /// Returns the mean of the points at rest.
  const Eigen::Vector3d& centre() const { return from_; }
  /// Returns the number of directions in which the points have an extent, 0 to 3.
  int rank() const { return rank_; }
  /// Returns the main axes of the points, in columns, longest extent first. Orthonormal, right-handed.
  const Eigen::Matrix3d& axes() const { return axes_; }

 private:
  Points centred_;  ///< at rest, relative to `from_`
  Eigen::Vector3d from_;
  Eigen::Matrix3d axes_;
  Eigen::Vector3d squares_;  ///< sums of the squares along the axes
  int rank_ = 0;
  /// Of a plate, the places of the points along its third axis, less what is quadratic in those along the
  /// others; else empty.
  Eigen::VectorXd thin_;
};

}  // namespace stackabilization::detail
