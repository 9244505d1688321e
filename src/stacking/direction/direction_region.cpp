#include "stackabilization/stacking/direction_region.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <numbers>

#include "core/angles.h"
#include "stackabilization/core/direction.h"
#include "stackabilization/core/errors.h"
#include "stackabilization/core/tolerances.h"

namespace stackabilization {

namespace {

/// Points of a Fibonacci lattice on the cap around `axis`.
std::vector<Eigen::Vector3d> cap(const Eigen::Vector3d& axis, double half_angle, double spacing) {
  constexpr double golden_angle = 2.399963229728653;
  const double height = 1 - std::cos(half_angle);
  // A cap so small that its height rounds to 0 has a spacing whose square may underflow.
  const double points = height > 0 ? std::ceil(2 * std::numbers::pi * height / (spacing * spacing)) : 1;
  const int count = std::max(1, static_cast<int>(points));
  const Frame frame = frame_of(Direction(axis));
  std::vector<Eigen::Vector3d> directions;
  directions.reserve(count);
  for (int i = 0; i < count; ++i) {
    const double z = 1 - height * (i + 0.5) / count, radius = std::sqrt((1 - z) * (1 + z)),
                 angle = golden_angle * i;
    directions.push_back(frame.to_world({radius * std::cos(angle), radius * std::sin(angle), z}));
  }
  return directions;
}

}  // namespace

DirectionRegion::DirectionRegion(const std::optional<DirectionCone>& cone,
                                 const std::optional<Eigen::Vector3d>& plane_normal)
    : cone_(cone), plane_normal_(plane_normal) {
  if (cone_) {
    if (!(cone_->half_angle > 0) || cone_->half_angle > std::numbers::pi / 2)
      throw UsageError("the half angle of the cone of directions must be above 0 and at most 90 degrees");
    cone_->axis = Direction(cone_->axis).unit();
  }
  if (plane_normal_) plane_normal_ = Direction(*plane_normal_).unit();
}

Eigen::Vector3d DirectionRegion::with_sign(const Eigen::Vector3d& vector) const {
  double sign = cone_ ? vector.dot(cone_->axis) : 0;
  for (int k = 2; k >= 0 && sign == 0; --k) sign = vector[k];
  return ((sign < 0 ? -vector : vector).array() + 0.0).matrix();
}

std::optional<Eigen::Vector3d> DirectionRegion::member(const Eigen::Vector3d& vector) const {
  const Eigen::Vector3d result = with_sign(Direction(vector).vector());
  if (plane_normal_ && std::abs(result.dot(*plane_normal_)) > tolerance::relative * result.norm())
    return std::nullopt;
  if (cone_ && detail::angle_between(result, cone_->axis) > cone_->half_angle + tolerance::relative)
    return std::nullopt;
  return result;
}

std::optional<Eigen::Vector3d> DirectionRegion::nearest(const Eigen::Vector3d& vector) const {
  if (!plane_normal_ && !cone_) return with_sign(vector.normalized());
  if (plane_normal_) {
    const Eigen::Vector3d projected = vector - *plane_normal_ * plane_normal_->dot(vector);
    if (projected.norm() <= tolerance::relative * vector.norm()) return std::nullopt;
    return member(projected.normalized());
  }
  const Eigen::Vector3d unit = with_sign(vector.normalized());
  if (detail::angle_between(unit, cone_->axis) <= cone_->half_angle) return unit;
  const Eigen::Vector3d away = (unit - cone_->axis * cone_->axis.dot(unit)).normalized();
  return cone_->axis * std::cos(cone_->half_angle) + away * std::sin(cone_->half_angle);
}

std::vector<Eigen::Vector3d> DirectionRegion::samples(double spacing) const {
  const double width = cone_ ? 2 * cone_->half_angle : std::numbers::pi;
  const double step = std::min(spacing, width / 6);
  const Eigen::Vector3d axis = cone_ ? cone_->axis : Eigen::Vector3d::UnitZ();
  const std::vector<Eigen::Vector3d> all =
      plane_normal_ ? half_circle(*plane_normal_, step) : cap(axis, width / 2, step);
  std::vector<Eigen::Vector3d> inside;
  for (const Eigen::Vector3d& direction : all)
    if (const auto found = member(direction)) inside.push_back(*found);
  return inside;
}

std::vector<Eigen::Vector3d> half_circle(const Eigen::Vector3d& normal, double spacing) {
  const Frame frame = frame_of(Direction(normal));
  const int count = static_cast<int>(std::ceil(std::numbers::pi / spacing));
  std::vector<Eigen::Vector3d> directions;
  directions.reserve(count);
  for (int i = 0; i < count; ++i) {
    const double angle = std::numbers::pi * i / count;
    directions.push_back(frame.u * std::cos(angle) + frame.v * std::sin(angle));
  }
  return directions;
}

}  // namespace stackabilization
