#include "mesh/barycentric.h"

#include <Eigen/QR>

namespace stackabilization::detail {

Eigen::Vector3d barycentric_weights(const Shape& shape, Eigen::Index triangle, const Eigen::Vector3d& point) {
  const Eigen::Vector3d a = shape.corner(triangle, 0);
  Eigen::Matrix<double, 3, 2> sides;
  sides << shape.corner(triangle, 1) - a, shape.corner(triangle, 2) - a;
  const Eigen::Vector2d w = sides.colPivHouseholderQr().solve(point - a);
  return {1 - w(0) - w(1), w(0), w(1)};
}

Eigen::Vector3d point_at(const Shape& shape, Eigen::Index triangle, const Eigen::Vector3d& weights) {
  return weights(0) * shape.corner(triangle, 0) + weights(1) * shape.corner(triangle, 1) +
         weights(2) * shape.corner(triangle, 2);
}

}  // namespace stackabilization::detail
