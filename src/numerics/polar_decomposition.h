#pragma once

#include <Eigen/Core>

namespace stackabilization::detail {

/// Polar decomposition M = R S of a 3 x 3 matrix: R is the rotation nearest to M in the Frobenius norm
/// (Kabsch 1976), S is symmetric.
struct PolarDecomposition {
  Eigen::Matrix3d rotation;  ///< R, also where M mirrors
  Eigen::Matrix3d axes;      ///< columns: orthonormal eigenvectors of S
  /// Eigenvalues of S, by descending absolute value. Only the last one is negative, where M mirrors.
  Eigen::Vector3d factors;

  Eigen::Matrix3d stretch() const { return axes * factors.asDiagonal() * axes.transpose(); }  ///< S
};

/// Computes the polar decomposition by singular values. Precondition: all entries are finite. For a singular
/// matrix R is one of the nearest rotations.
PolarDecomposition polar_decomposition(const Eigen::Matrix3d& matrix);

}  // namespace stackabilization::detail
