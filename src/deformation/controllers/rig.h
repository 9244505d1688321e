#pragma once

#include <Eigen/Core>
#include <array>
#include <vector>

#include "deformation/controllers/control_space.h"
#include "deformation/model/binding.h"
#include "stackabilization/structure/structure.h"

namespace stackabilization::detail {

/// A joint point with both of its parts.
struct JointPoint {
  int relation = 0;  ///< row of Structure::relations
  std::array<int, 2> parts;
  std::array<PointBinding, 2> bindings;
};

/// Everything about the controls of a structure that depends on its rest alone. Immutable, safe to share
/// between threads.
struct Rig {
  /// Throws InputError as ControlSpace does.
  explicit Rig(const Structure& rest);

  Structure rest;
  ControlSpace space;
  std::vector<Carrier> carriers;              ///< per part
  std::vector<JointPoint> joints;             ///< a line joint has two
  std::vector<int> distinct_joints;           ///< rows of joints, see joint_copies.h
  std::vector<Eigen::MatrixXd> edit_kernels;  ///< per class, within what its self-symmetries leave free
  std::vector<Eigen::MatrixXd> bases;         ///< per class, likewise: see correction_basis.h
  std::vector<double> strains;                ///< per class: strain_length
  std::vector<Eigen::MatrixXd> slides;        ///< per class; empty but for open cylinders: slide_functions
  std::vector<Eigen::MatrixXd> turnings;      ///< per class; empty for cuboids
};

}  // namespace stackabilization::detail
