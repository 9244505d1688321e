#include "deformation/model/binding.h"

#include <algorithm>
#include <cmath>

#include "stackabilization/deformation/tolerances.h"

namespace stackabilization::detail {

namespace {

using BoxCorners = Eigen::Matrix<double, 8, 3, Eigen::RowMajor>;

ControlJacobian cage_jacobian(const CageBinding& binding) {
  ControlJacobian jacobian;
  for (int k = 0; k < 8; ++k)
    jacobian.points.push_back({k, binding.weights(k) * Eigen::Matrix3d::Identity()});
  return jacobian;
}

ControlJacobian box_jacobian(const HollowBoxAtRest& box, const HollowBoxBinding& binding, const Cuboid& now) {
  const HollowBoxMotion motion = box.motion(now);
  ControlJacobian jacobian;
  for (int k = 0; k < 8; ++k) jacobian.points.push_back({k, box.derivative(binding, motion, k)});
  return jacobian;
}

/// Returns the sections whose centres influence a point between two neighbouring ones: these two and, because
/// of their tangents, one more on either side.
std::vector<int> sections_around(const CurveBinding& binding, const GeneralizedCylinder& cylinder) {
  const int n = static_cast<int>(cylinder.centres.rows());
  const auto step = [&](int i, int by) {
    return cylinder.closed ? (i + by + n) % n : std::clamp(i + by, 0, n - 1);
  };
  std::vector<int> sections = {step(binding.from, -1), binding.from, binding.to, step(binding.to, 1)};
  std::sort(sections.begin(), sections.end());
  sections.erase(std::unique(sections.begin(), sections.end()), sections.end());
  return sections;
}

ControlJacobian curve_jacobian(const CurveAtRest& curve, const CurveBinding& binding,
                               GeneralizedCylinder now) {
  const Eigen::Vector3d here = curve.position_of(binding, now);
  const double size =
      (curve.cylinder().centres.row(binding.to) - curve.cylinder().centres.row(binding.from)).norm() +
      curve.cylinder().radii(binding.from);
  const double step = tolerance::difference_step * size;
  const std::vector<int> sections = sections_around(binding, now);
  const auto slope = [&](double& variable) -> Eigen::Vector3d {
    const double before = variable;
    variable += step;
    const Eigen::Vector3d there = curve.position_of(binding, now);
    const double varied = variable - before;
    variable = before;
    return (there - here) / varied;
  };
  ControlJacobian jacobian;
  for (const int i : sections) {
    Eigen::Matrix3d block;
    for (int k = 0; k < 3; ++k) block.col(k) = slope(now.centres(i, k));
    jacobian.points.push_back({i, block});
  }
  for (const int i : {binding.from, binding.to}) jacobian.radii.push_back({i, slope(now.radii(i))});
  const Eigen::Quaterniond rotation = now.rotation;
  for (int k = 0; k < 3; ++k) {
    now.rotation = Eigen::AngleAxisd(tolerance::difference_step, Eigen::Vector3d::Unit(k)) * rotation;
    jacobian.rotation.col(k) = (curve.position_of(binding, now) - here) / tolerance::difference_step;
  }
  return jacobian;
}

}  // namespace

PrimitiveBinding::PrimitiveBinding(const Primitive& rest) : rest_(rest) {
  if (const auto* cylinder = std::get_if<GeneralizedCylinder>(&rest))
    at_rest_ = CurveAtRest(*cylinder);
  else if (is_hollow(std::get<Cuboid>(rest)))
    at_rest_ = HollowBoxAtRest(std::get<Cuboid>(rest));
}

PointBinding PrimitiveBinding::bind(const Eigen::Vector3d& point) const {
  return bind(Points(point.transpose())).front();
}

std::vector<PointBinding> PrimitiveBinding::bind(const Points& points) const {
  std::vector<PointBinding> bindings(static_cast<std::size_t>(points.rows()));
  if (const auto* curve = std::get_if<CurveAtRest>(&at_rest_)) {
    for (std::size_t i = 0; i < bindings.size(); ++i)
      bindings[i] = curve->bind(points.row(static_cast<Eigen::Index>(i)).transpose());
    return bindings;
  }
  if (const auto* box = std::get_if<HollowBoxAtRest>(&at_rest_)) {
    std::vector<HollowBoxBinding> bound = box->bind(points);
    std::move(bound.begin(), bound.end(), bindings.begin());
    return bindings;
  }
  const CornerWeights weights = mean_value_coordinates(std::get<Cuboid>(rest_), points);
  for (std::size_t i = 0; i < bindings.size(); ++i) {
    const auto column = static_cast<Eigen::Index>(i);
    bindings[i] = CageBinding{points.row(column).transpose(), weights.col(column)};
  }
  return bindings;
}

Eigen::Vector3d PrimitiveBinding::position_of(const PointBinding& binding, const Primitive& now) const {
  if (const auto* curve = std::get_if<CurveAtRest>(&at_rest_))
    return curve->position_of(std::get<CurveBinding>(binding), std::get<GeneralizedCylinder>(now));
  if (const auto* box = std::get_if<HollowBoxAtRest>(&at_rest_))
    return box->position_of(std::get<HollowBoxBinding>(binding), box->motion(std::get<Cuboid>(now)));
  const auto& [point, weights] = std::get<CageBinding>(binding);
  const BoxCorners moved = std::get<Cuboid>(now).corners - std::get<Cuboid>(rest_).corners;
  return point + moved.transpose() * weights;
}

Points PrimitiveBinding::displacements(const std::vector<PointBinding>& bindings,
                                       const Primitive& now) const {
  Points moved(static_cast<Eigen::Index>(bindings.size()), 3);
  if (const auto* curve = std::get_if<CurveAtRest>(&at_rest_)) {
    const auto& cylinder = std::get<GeneralizedCylinder>(now);
    std::vector<DualQuaternion> motions;
    for (int i = 0; i < cylinder.centres.rows(); ++i) motions.push_back(curve->motion(cylinder, i));
    for (std::size_t i = 0; i < bindings.size(); ++i) {
      const auto& binding = std::get<CurveBinding>(bindings[i]);
      const Eigen::Vector3d rest = curve->origin() + binding.axis + binding.radial + binding.axial;
      moved.row(static_cast<Eigen::Index>(i)) =
          curve->position_of(binding, cylinder, motions[static_cast<std::size_t>(binding.from)],
                             motions[static_cast<std::size_t>(binding.to)]) -
          rest;
    }
    return moved;
  }
  if (const auto* box = std::get_if<HollowBoxAtRest>(&at_rest_)) {
    const HollowBoxMotion motion = box->motion(std::get<Cuboid>(now));
    for (std::size_t i = 0; i < bindings.size(); ++i) {
      const auto& binding = std::get<HollowBoxBinding>(bindings[i]);
      moved.row(static_cast<Eigen::Index>(i)) = box->position_of(binding, motion) - binding.point;
    }
    return moved;
  }
  const BoxCorners corners = std::get<Cuboid>(now).corners - std::get<Cuboid>(rest_).corners;
  for (std::size_t i = 0; i < bindings.size(); ++i)
    moved.row(static_cast<Eigen::Index>(i)).noalias() =
        std::get<CageBinding>(bindings[i]).weights.transpose() * corners;
  return moved;
}

ControlJacobian PrimitiveBinding::jacobian(const PointBinding& binding, const Primitive& now) const {
  if (const auto* curve = std::get_if<CurveAtRest>(&at_rest_))
    return curve_jacobian(*curve, std::get<CurveBinding>(binding), std::get<GeneralizedCylinder>(now));
  if (const auto* box = std::get_if<HollowBoxAtRest>(&at_rest_))
    return box_jacobian(*box, std::get<HollowBoxBinding>(binding), std::get<Cuboid>(now));
  return cage_jacobian(std::get<CageBinding>(binding));
}

}  // namespace stackabilization::detail
