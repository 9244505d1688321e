#pragma once

#include <Eigen/Core>
#include <optional>
#include <vector>

#include "deformation/controllers/corrections.h"
#include "deformation/controllers/rig.h"

namespace stackabilization::detail {

/// A point that rides on a part, with a weight in a sum of such.
struct Rider {
  int part = 0;
  PointBinding binding;
  double weight = 1;
};

/// The weighted sum of riding points is `target`; or, with a normal, its height along the normal is `height`
/// above a level that is free, or above 0.
struct Constraint {
  std::vector<Rider> riders;
  Eigen::Vector3d target = Eigen::Vector3d::Zero();
  std::optional<Eigen::Vector3d> normal;  ///< unit
  double height = 0;                      ///< with a normal, model units
  std::optional<int> level;               ///< with a normal, row of SolverState::levels; nothing: 0
};

struct SolverState {
  std::vector<ControlState> controls;  ///< per class
  Eigen::VectorXd levels;              ///< free levels of constraints with a normal, model units
};

/// One per joint point of the rig that is no symmetric copy of another, in its order.
std::vector<Constraint> joint_constraints(const Rig& rig);

/// Largest violation of the constraints, model units.
double largest_gap(const Rig& rig, const std::vector<Constraint>& constraints, const SolverState& state);

/// Gauss-Newton on all constraints at once, each step the one of least norm in the columns of `corrections`,
/// which settle it: the normal equations in their dual form, a small dense system, with
/// constraints that repeat others left out by a pivoted Cholesky factorisation. Stops at tolerance::solve of
/// the diagonal or where steps do not help any more: look at `largest_gap`.
SolverState solved(const Rig& rig, Corrections& corrections, const std::vector<Constraint>& constraints,
                   SolverState start);

}  // namespace stackabilization::detail
