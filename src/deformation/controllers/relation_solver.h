#pragma once

#include <Eigen/Core>
#include <array>
#include <optional>
#include <vector>

#include "deformation/controllers/corrections.h"
#include "deformation/controllers/rig.h"

namespace stackabilization::detail {

/// A point bound to a part, with a weight in a sum of such points: a multiple of the identity where all of
/// the point counts, of a projector where a component does.
struct BoundPoint {
  int part = 0;
  PointBinding binding;
  Eigen::Matrix3d weight = Eigen::Matrix3d::Identity();
};

/// An equation for a weighted sum of bound points. Without a normal, the sum equals `target`. With a normal,
/// the height of the sum along the normal is `height` above a level, which is a free unknown or 0.
struct Constraint {
  std::vector<BoundPoint> bound_points;
  Eigen::Vector3d target = Eigen::Vector3d::Zero();
  /// Part on which a joint may slide: only the directions in which it is held count (joint_slides.h).
  std::optional<int> carrier = {};
  std::array<bool, 3> ways{};  ///< see Relation::sliding; only with a carrier
  double slack = 0;            ///< length of the sum, less `target`, that counts as none; model units
  std::optional<Eigen::Vector3d> normal;  ///< unit normal
  double height = 0;                      ///< height above the level, model units; only with a normal
  /// Row of SolverState::levels, only with a normal; without a value the level is 0.
  std::optional<int> level;
};

/// Unknowns of the solver.
struct SolverState {
  std::vector<ControlState> controls;  ///< state of each class
  Eigen::VectorXd levels;              ///< free levels of the constraints with a normal, model units
};

/// Returns one constraint per joint point of the rig that is no symmetric copy of another one, in the order
/// of the rig.
std::vector<Constraint> joint_constraints(const Rig& rig);

/// Returns one constraint per row point of the rig, in its order: even steps of a row stay even.
std::vector<Constraint> row_constraints(const Rig& rig);

/// Returns the residuals of the constraints beyond their slack, model units: one of a constraint with a
/// normal, three of any other.
Eigen::VectorXd gaps(const Rig& rig, const std::vector<Constraint>& constraints, const SolverState& state);

/// Returns the largest absolute residual of the constraints beyond their slack, model units.
double largest_gap(const Rig& rig, const std::vector<Constraint>& constraints, const SolverState& state);

/// Solves all constraints at once by Gauss-Newton. A constraint with slack takes part from the step on at
/// which it goes beyond its slack, and then as far as to its end. Each step has the least norm in the columns
/// of `corrections`, which then settle the state. The normal equations are solved in their dual form, a small
/// dense system, by a pivoted Cholesky factorisation that omits redundant constraints. Stops when the
/// residuals are within tolerance::solve of the diagonal, or when steps no longer reduce them: check the
/// result with `largest_gap`.
SolverState solve_relations(const Rig& rig, CorrectionSpace& corrections,
                            const std::vector<Constraint>& constraints, SolverState start);

}  // namespace stackabilization::detail
