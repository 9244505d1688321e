#include "stackabilization/structure/symmetry.h"

#include <numbers>

namespace stackabilization {

std::string name_of(SymmetryKind kind) {
  switch (kind) {
    case SymmetryKind::reflection:
      return "reflection";
    case SymmetryKind::rotation:
      return "rotation";
    case SymmetryKind::revolution:
      return "revolution";
  }
  return {};
}

Eigen::Isometry3d isometry_of(const Symmetry& symmetry) {
  Eigen::Isometry3d map = Eigen::Isometry3d::Identity();
  if (symmetry.kind == SymmetryKind::reflection)
    map.linear() -= 2 * symmetry.axis * symmetry.axis.transpose();
  else if (symmetry.kind == SymmetryKind::revolution || symmetry.order == 2)
    map.linear() = 2 * symmetry.axis * symmetry.axis.transpose() - Eigen::Matrix3d::Identity();
  else
    map.linear() = Eigen::AngleAxisd(2 * std::numbers::pi / symmetry.order, symmetry.axis).toRotationMatrix();
  map.translation() = symmetry.point - map.linear() * symmetry.point;
  return map;
}

Symmetry bisector(const Eigen::Vector3d& a, const Eigen::Vector3d& b) {
  return {.kind = SymmetryKind::reflection, .point = (a + b) / 2, .axis = (b - a).normalized(), .order = 2};
}

}  // namespace stackabilization
