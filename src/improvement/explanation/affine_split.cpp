#include "improvement/explanation/affine_split.h"

#include <Eigen/Geometry>
#include <Eigen/LU>
#include <Eigen/SVD>
#include <cmath>
#include <limits>

#include "stackabilization/improvement/tolerances.h"

namespace stackabilization::detail {

namespace {

using tolerance::explanation::level;

/// Rotation and stretches: linear = turn * axes * diag(factors) * axes^T.
template <int Size>
struct Polar {
  Eigen::Matrix<double, Size, Size> turn, axes;
  Eigen::Matrix<double, Size, 1> factors;
};

template <int Size>
Polar<Size> polar(const Eigen::Matrix<double, Size, Size>& linear) {
  const Eigen::JacobiSVD<Eigen::Matrix<double, Size, Size>> svd(linear,
                                                                Eigen::ComputeFullU | Eigen::ComputeFullV);
  return {svd.matrixU() * svd.matrixV().transpose(), svd.matrixV(), svd.singularValues()};
}

}  // namespace

double AffineSplit::total_stretch() const {
  if (!(factors.minCoeff() > 0)) return std::numeric_limits<double>::infinity();
  return factors.array().log().abs().sum();
}

AffineSplit split_affine(const Eigen::Matrix3d& linear, const Eigen::Vector3d& up) {
  const Polar<3> whole = polar<3>(linear);
  AffineSplit best{whole.turn, whole.axes, whole.factors};
  Eigen::Matrix3d frame;
  frame << up.unitOrthogonal(), Eigen::Vector3d::Zero(), up;
  frame.col(1) = up.cross(frame.col(0));
  const Eigen::Matrix3d map = frame.transpose() * linear * frame;
  const bool keeps_level = map.bottomLeftCorner<1, 2>().norm() <= level,
             keeps_upright = map.topRightCorner<2, 1>().norm() <= level;
  if (!keeps_level && !keeps_upright) return best;
  const Polar<2> across = polar<2>(map.topLeftCorner<2, 2>());
  AffineSplit sheared;
  sheared.axes.col(2) = up;
  sheared.axes.leftCols<2>() = frame.leftCols<2>() * across.axes;
  sheared.factors << across.factors, map(2, 2);
  if (sheared.total_stretch() + tolerance::explanation::same_split > best.total_stretch()) return best;
  sheared.turn =
      linear * sheared.axes * sheared.factors.cwiseInverse().asDiagonal() * sheared.axes.transpose();
  return sheared;
}

}  // namespace stackabilization::detail
