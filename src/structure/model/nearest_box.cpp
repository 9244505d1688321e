#include "structure/model/nearest_box.h"

#include <Eigen/Geometry>
#include <Eigen/SVD>
#include <array>

#include "stackabilization/core/tolerances.h"

namespace stackabilization {

namespace {

double size_of(const Cuboid& cuboid) {
  return (cuboid.corners.colwise().maxCoeff() - cuboid.corners.colwise().minCoeff()).norm();
}

/// Columns: unit directions of `edges`. For an edge without length, a direction perpendicular to the others.
Eigen::Matrix3d directions(const Eigen::Matrix3d& edges, double rounding) {
  Eigen::Matrix3d result = Eigen::Matrix3d::Zero();
  std::array<bool, 3> known{};
  for (int a = 0; a < 3; ++a)
    if (edges.col(a).norm() > rounding) {
      result.col(a) = edges.col(a).normalized();
      known[static_cast<std::size_t>(a)] = true;
    }
  for (int a = 0; a < 3; ++a) {
    const int b = (a + 1) % 3, c = (a + 2) % 3;
    if (known[static_cast<std::size_t>(a)]) continue;
    if (known[static_cast<std::size_t>(b)] && known[static_cast<std::size_t>(c)])
      result.col(a) = result.col(b).cross(result.col(c)).normalized();
    else if (known[static_cast<std::size_t>(b)] || known[static_cast<std::size_t>(c)])
      result.col(a) = result.col(known[static_cast<std::size_t>(b)] ? b : c).unitOrthogonal();
    else
      result.col(a) = Eigen::Vector3d::Unit(a);
    known[static_cast<std::size_t>(a)] = true;
  }
  return result;
}

}  // namespace

OrientedBox nearest_box(const Cuboid& cuboid) {
  const Eigen::RowVector3d centre = cuboid.corners.colwise().mean();
  Eigen::Matrix3d edges = Eigen::Matrix3d::Zero();  // half of the mean edge along each axis
  for (int k = 0; k < 8; ++k)
    for (int a = 0; a < 3; ++a)
      edges.col(a) += ((k >> a & 1) != 0 ? 1.0 : -1.0) / 8 * (cuboid.corners.row(k) - centre).transpose();

  const Eigen::Matrix3d unit = directions(edges, tolerance::rounding * size_of(cuboid));
  const Eigen::JacobiSVD<Eigen::Matrix3d> svd(unit, Eigen::ComputeFullU | Eigen::ComputeFullV);
  OrientedBox box;
  box.centre = centre.transpose();
  box.axes = svd.matrixU() * svd.matrixV().transpose();
  for (int a = 0; a < 3; ++a) box.half_extents(a) = edges.col(a).dot(box.axes.col(a));
  return box;
}

bool is_box(const Cuboid& cuboid) {
  const double miss = (cuboid_of(nearest_box(cuboid)).corners - cuboid.corners).rowwise().norm().maxCoeff();
  return miss <= tolerance::relative * size_of(cuboid);
}

}  // namespace stackabilization
