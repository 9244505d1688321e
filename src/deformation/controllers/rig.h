#pragma once

#include <Eigen/Core>
#include <array>
#include <vector>

#include "deformation/controllers/control_space.h"
#include "deformation/model/binding.h"
#include "stackabilization/deformation/controller_model.h"
#include "stackabilization/structure/structure.h"

namespace stackabilization::detail {

/// A joint point bound to both of its parts.
struct JointPoint {
  int relation = 0;  ///< row of Structure::relations
  int point = 0;     ///< row of Relation::points
  std::array<int, 2> parts;
  std::array<PointBinding, 2> bindings;
};

/// Points of three consecutive parts of a row at even steps, each bound to its part. They stay at even steps,
/// as they do under every affine map of the whole.
struct RowPoint {
  std::array<int, 3> parts;
  std::array<PointBinding, 3> bindings;
};

/// Data of the controls of a structure that depend on its rest pose alone, computed once. Immutable, safe to
/// share between threads.
struct Rig {
  /// Throws InputError under the conditions of ControlSpace.
  explicit Rig(const Structure& rest, Following following = Following::free);

  Structure rest;
  ControlSpace space;
  std::vector<PrimitiveBinding> primitive_bindings;  ///< binding of each part
  std::vector<JointPoint> joints;                    ///< points of all joints; a line joint has two
  std::vector<int> distinct_joints;                  ///< rows of `joints`, see joint_copies.h
  std::vector<RowPoint> row_points;                  ///< Following::smooth keeps rows even, see row_points.h
  /// Per class: edit_kernel, projected to the subspace of its self-symmetries.
  std::vector<Eigen::MatrixXd> edit_kernels;
  std::vector<Eigen::MatrixXd> bases;  ///< per class: reduced_basis, projected likewise
  /// Per class: the basis of Following::free, projected likewise. Tapers make no affine maps of parts, and so
  /// need these to close joints.
  std::vector<Eigen::MatrixXd> free_bases;
  std::vector<double> strains;  ///< per class: strain_scale
  /// Per class: slide_functions of an open cylinder, otherwise empty, and without columns for small parts
  /// (strain_scale below 1) with Following::smooth.
  std::vector<Eigen::MatrixXd> slides;
  /// Per class: `turning` of a generalized cylinder, empty for a cuboid.
  std::vector<Eigen::MatrixXd> turnings;
};

}  // namespace stackabilization::detail
