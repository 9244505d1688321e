#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>

namespace stackabilization {

/// Kinds of isometries that shapes are tested for.
enum class SymmetryKind {
  reflection,  ///< in the plane through `point` with normal `axis`
  rotation,    ///< by 2 pi / `order` about the line through `point` along `axis`
  revolution,  ///< by any angle about that line
};

/// A symmetry of a shape or of a part, model units.
struct Symmetry {
  SymmetryKind kind = SymmetryKind::reflection;     ///< what it does
  Eigen::Vector3d point = Eigen::Vector3d::Zero();  ///< of the plane or line
  Eigen::Vector3d axis = Eigen::Vector3d::UnitX();  ///< unit
  int order = 2;                                    ///< of a rotation; not used otherwise
};

/// The map p -> Q p + t of a symmetry: its reflection (det Q = -1), its rotation by 2 pi / order, and for a
/// revolution the half turn, whose fixed points are the axis.
Eigen::Isometry3d isometry_of(const Symmetry& symmetry);

/// The reflection that swaps a and b. Precondition: a != b.
Symmetry bisector(const Eigen::Vector3d& a, const Eigen::Vector3d& b);

}  // namespace stackabilization
