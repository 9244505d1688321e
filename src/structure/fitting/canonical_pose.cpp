#include "structure/fitting/canonical_pose.h"

#include <Eigen/LU>
#include <algorithm>
#include <array>
#include <cmath>

#include "mesh/surface_moments.h"
#include "structure/fitting/part_box.h"

namespace stackabilization::detail {

namespace {

constexpr double grid = 0x1p24;  ///< steps along the diagonal

/// Third moments of the surface along the axes, its triangles shrunk to their centres.
Eigen::Vector3d skewness(const Shape& part) {
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  for (Eigen::Index t = 0; t < part.triangle_count(); ++t) {
    const Eigen::Vector3d a = part.corner(t, 0), b = part.corner(t, 1), c = part.corner(t, 2);
    sum += 2 * area_vector(a, b, c).norm() * ((a + b + c) / 3).array().cube().matrix();
  }
  return sum;
}

}  // namespace

CanonicalPose canonical_pose(const Shape& part, const OrientedBox& box) {
  CanonicalPose pose{.part = {}, .centre = box.centre, .axes = {}, .diagonal = 2 * box.half_extents.norm()};
  const std::array<int, 3> order = axes_by_length(box);
  for (int k = 0; k < 3; ++k) pose.axes.col(k) = box.axes.col(order[static_cast<std::size_t>(k)]);
  const Eigen::Vector3d skew =
      skewness(transformed(part, pose.axes.transpose(), -pose.axes.transpose() * box.centre));
  for (int k = 0; k < 3; ++k)
    if (skew(k) < 0) pose.axes.col(k) *= -1;

  pose.part = transformed(part, pose.axes.transpose(), -pose.axes.transpose() * box.centre);
  pose.part.vertices = (pose.part.vertices / (pose.diagonal / grid)).array().round() / grid;
  const bool mirrored = pose.axes.determinant() < 0;
  for (auto triangle : pose.part.triangles.rowwise()) {
    std::rotate(triangle.begin(), std::min_element(triangle.begin(), triangle.end()), triangle.end());
    if (mirrored) std::swap(triangle(1), triangle(2));
  }
  return pose;
}

}  // namespace stackabilization::detail
