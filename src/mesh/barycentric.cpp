#include "mesh/barycentric.h"

#include <Eigen/QR>

namespace stackabilization::detail {

Eigen::Vector3d barycentric_weights(const Shape& shape, Eigen::Index triangle, const Eigen::Vector3d& point) {
  Eigen::Matrix3d corners;
  for (int i = 0; i < 3; ++i) corners.row(i) = shape.corner(triangle, i).transpose();
  return barycentric_weights(corners, point);
}

Eigen::Vector3d barycentric_weights(const Eigen::Matrix3d& corners, const Eigen::Vector3d& point) {
  const Eigen::Vector3d a = corners.row(0).transpose();
  Eigen::Matrix<double, 3, 2> sides;
  sides << corners.row(1).transpose() - a, corners.row(2).transpose() - a;
  const Eigen::Vector2d w = sides.colPivHouseholderQr().solve(point - a);
  return {1 - w(0) - w(1), w(0), w(1)};
}

Eigen::Vector3d point_at(const Shape& shape, Eigen::Index triangle, const Eigen::Vector3d& weights) {
  return weights(0) * shape.corner(triangle, 0) + weights(1) * shape.corner(triangle, 1) +
         weights(2) * shape.corner(triangle, 2);
}

}  // namespace stackabilization::detail
