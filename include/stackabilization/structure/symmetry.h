#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <string>

namespace stackabilization {

/// Kind of an isometry that maps a shape to itself.
enum class SymmetryKind {
  reflection,  ///< reflection in the plane through `point` with normal `axis`
  rotation,    ///< rotation by 2 pi / `order` about the line through `point` along `axis`
  revolution,  ///< rotation by every angle about that line
};

/// Returns "reflection", "rotation" or "revolution".
std::string name_of(SymmetryKind kind);

/// A symmetry of a shape or of a part, model units.
struct Symmetry {
  SymmetryKind kind = SymmetryKind::reflection;     ///< kind of the isometry
  Eigen::Vector3d point = Eigen::Vector3d::Zero();  ///< point of the plane or line
  /// Unit normal of the plane, or unit direction of the line.
  Eigen::Vector3d axis = Eigen::Vector3d::UnitX();
  int order = 2;  ///< order of a rotation; unused for the other kinds
};

/// Returns the map p -> Q p + t of a symmetry: the reflection (det Q = -1), or the rotation by 2 pi / order.
/// For a revolution it is the half turn; its fixed points are the axis.
Eigen::Isometry3d isometry_of(const Symmetry& symmetry);

/// Returns the reflection that exchanges a and b. Precondition: a != b.
Symmetry bisector(const Eigen::Vector3d& a, const Eigen::Vector3d& b);

}  // namespace stackabilization
