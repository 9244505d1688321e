#include "numerics/polar_decomposition.h"

#include <Eigen/LU>
#include <Eigen/SVD>

namespace stackabilization::detail {

PolarDecomposition polar_decomposition(const Eigen::Matrix3d& matrix) {
  const Eigen::JacobiSVD<Eigen::Matrix3d> svd(matrix, Eigen::ComputeFullU | Eigen::ComputeFullV);
  const bool mirrors = svd.matrixU().determinant() * svd.matrixV().determinant() < 0;
  const Eigen::Vector3d signs(1, 1, mirrors ? -1 : 1);
  return {svd.matrixU() * signs.asDiagonal() * svd.matrixV().transpose(), svd.matrixV(),
          signs.cwiseProduct(svd.singularValues())};
}

}  // namespace stackabilization::detail
