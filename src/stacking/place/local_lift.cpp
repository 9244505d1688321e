#include "stacking/place/local_lift.h"

#include <Eigen/Geometry>
#include <cstddef>
#include <numbers>
#include <optional>

#include "stackabilization/stacking/rigid_transform.h"

namespace stackabilization::detail {
namespace {

/// Turned trees that are kept.
constexpr std::size_t max_trees = 64;

}  // namespace

LocalLift::LocalLift(const LocalShapes& shapes, ContactSemantics semantics)
    : shapes_(shapes), semantics_(semantics), base_(shapes.base) {
  const Eigen::Vector3d up = Eigen::Vector3d::UnitZ();
  floor_ = range_along(shapes.base, up).low - range_along(shapes.shape, up).low;
}

Touch LocalLift::operator()(const LocalPlace& place) {
  const SeparationTree moved = turned(place.yaw).translated({place.x, place.y, 0});
  const Separation found = separation(base_, moved, Direction(0, 0, 1), {semantics_, std::nullopt});
  if (!found.blocked || found.length < floor_) return {floor_};
  const Eigen::Vector2d touching = found.witness.lower_point.head<2>() - Eigen::Vector2d(place.x, place.y);
  return {found.length, false, Eigen::Rotation2Dd(-place.yaw) * touching,
          found.witness.upper_point.head<2>()};
}

const SeparationTree& LocalLift::turned(double yaw) {
  if (const auto known = trees_.find(yaw); known != trees_.end()) return known->second;
  if (trees_.size() == max_trees) trees_.clear();
  const Line axis;
  const RigidTransform turn = rotation_about(axis, yaw * 180 / std::numbers::pi);
  return trees_.emplace(yaw, SeparationTree(transformed(shapes_.shape, turn))).first->second;
}

}  // namespace stackabilization::detail
