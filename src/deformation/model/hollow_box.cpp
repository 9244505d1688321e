#include "deformation/model/hollow_box.h"

#include <Eigen/Geometry>
#include <Eigen/LU>
#include <Eigen/QR>
#include <algorithm>

#include "deformation/model/mean_value_coordinates.h"
#include "numerics/polar_decomposition.h"

namespace stackabilization::detail {

namespace {

/// Returns the place that moves a point along an axis. Both lie `from_centre` from the centre, half extents;
/// the walls begin at `inner` on the negative and the positive side.
double moving_place(double from_centre, const Eigen::RowVector2d& inner) {
  if (inner(0) == 1 && inner(1) == 1) return from_centre;
  return std::clamp((2 * from_centre + inner(0) - inner(1)) / (inner(0) + inner(1)), -1.0, 1.0);
}

}  // namespace

bool is_hollow(const Cuboid& cuboid) {
  return !cuboid.inner_sides.isOnes(0);
}

HollowBoxAtRest::HollowBoxAtRest(const Cuboid& rest)
    : rest_(rest), centre_(rest.corners.colwise().mean().transpose()) {
  for (int axis = 0; axis < 3; ++axis) {
    const Eigen::Vector3d edge = (rest.corners.row(1 << axis) - rest.corners.row(0)).transpose();
    half_extents_(axis) = edge.norm() / 2;
    axes_.col(axis) = edge.normalized();
  }
  for (int corner = 0; corner < 8; ++corner) {
    const Eigen::Vector3d signs((corner & 1) != 0 ? 1 : -1, (corner & 2) != 0 ? 1 : -1,
                                (corner & 4) != 0 ? 1 : -1);
    gradient_.row(corner) = (axes_ * signs.cwiseQuotient(8 * half_extents_)).transpose();
  }
}

std::vector<HollowBoxBinding> HollowBoxAtRest::bind(const Points& points) const {
  std::vector<HollowBoxBinding> bindings(static_cast<std::size_t>(points.rows()));
  const Points local = (points.rowwise() - centre_.transpose()) * axes_;
  Points moving = points, offsets(points.rows(), 3);
  for (int axis = 0; axis < 3; ++axis) {
    for (Eigen::Index i = 0; i < points.rows(); ++i) {
      const double place = half_extents_(axis) *
                           moving_place(local(i, axis) / half_extents_(axis), rest_.inner_sides.row(axis));
      offsets(i, axis) = local(i, axis) - place;
      moving.row(i) = points.row(i) - offsets(i, axis) * axes_.col(axis).transpose();
    }
    const CornerWeights weights = mean_value_coordinates(rest_, moving);
    for (std::size_t i = 0; i < bindings.size(); ++i)
      bindings[i].weights.col(axis) = weights.col(static_cast<Eigen::Index>(i));
  }
  for (std::size_t i = 0; i < bindings.size(); ++i) {
    const auto row = static_cast<Eigen::Index>(i);
    bindings[i].point = points.row(row).transpose();
    bindings[i].offset = axes_ * offsets.row(row).transpose();
  }
  return bindings;
}

HollowBoxMotion HollowBoxAtRest::motion(const Cuboid& now) const {
  HollowBoxMotion motion;
  motion.corners = now.corners.rowwise() - centre_.transpose();
  const PolarDecomposition polar = polar_decomposition(motion.corners.transpose() * gradient_);
  motion.rotation = polar.rotation;
  motion.stretch = polar.stretch();
  motion.axes = motion.rotation * axes_;
  return motion;
}

Eigen::Vector3d HollowBoxAtRest::position_of(const HollowBoxBinding& binding,
                                             const HollowBoxMotion& motion) const {
  Eigen::Vector3d position = centre_ + motion.rotation * binding.offset;
  for (int axis = 0; axis < 3; ++axis) {
    const Eigen::Vector3d along = motion.axes.col(axis);
    position += along.dot(motion.corners.transpose() * binding.weights.col(axis)) * along;
  }
  return position;
}

Eigen::Matrix3d HollowBoxAtRest::derivative(const HollowBoxBinding& binding, const HollowBoxMotion& motion,
                                            int corner) const {
  // With the affine map A = R S, a change dA turns R by the w of (trace(S) I - S) w = axial(R^T dA - dA^T R).
  const Eigen::Matrix3d strain = motion.stretch.trace() * Eigen::Matrix3d::Identity() - motion.stretch;
  const Eigen::CompleteOrthogonalDecomposition<Eigen::Matrix3d> solver(strain);
  const Eigen::Vector3d gradient = gradient_.row(corner).transpose();
  Eigen::Matrix3d derivative = Eigen::Matrix3d::Zero();
  for (int k = 0; k < 3; ++k) {
    const Eigen::Vector3d turned = motion.rotation.row(k).transpose(),
                          spin = motion.rotation * solver.solve(gradient.cross(turned));
    derivative.col(k) += spin.cross(motion.rotation * binding.offset);
    for (int axis = 0; axis < 3; ++axis) {
      const Eigen::Vector3d along = motion.axes.col(axis), across = spin.cross(along),
                            place = motion.corners.transpose() * binding.weights.col(axis);
      derivative.col(k) +=
          along.dot(place) * across + (across.dot(place) + binding.weights(corner, axis) * along(k)) * along;
    }
  }
  return derivative;
}

}  // namespace stackabilization::detail
