#pragma once

#include <Eigen/Core>

namespace stackabilization::detail {

/// A linear map as stretches along orthogonal axes, followed by a change of directions.
struct AffineSplit {
  /// What follows the stretches: a rotation, or a shear with a rotation about the upright axis.
  Eigen::Matrix3d turn = Eigen::Matrix3d::Identity();
  Eigen::Matrix3d axes = Eigen::Matrix3d::Identity();  ///< axes of the stretches at rest, unit columns
  Eigen::Vector3d factors = Eigen::Vector3d::Ones();   ///< stretches along the columns of `axes`

  /// Returns the sum of the absolute logarithms of the stretches; infinity where one is not positive.
  double total_stretch() const;
};

/// Splits a linear map in the way of least stretches (`total_stretch`): into stretches and a
/// rotation; where level planes stay level, also into stretches across and along `up` and a level shear, as
/// of a leaning panel between level boards; where upright lines stay upright, also into such stretches and an
/// upright shear. `up`: unit.
AffineSplit split_affine(const Eigen::Matrix3d& linear, const Eigen::Vector3d& up);

}  // namespace stackabilization::detail
