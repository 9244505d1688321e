#include "deformation/controllers/relation_solver.h"

#include <Eigen/SparseCore>
#include <algorithm>
#include <cmath>
#include <limits>

#include "core/index.h"
#include "deformation/model/joint_slides.h"
#include "stackabilization/deformation/tolerances.h"

namespace stackabilization::detail {

namespace {

constexpr int max_steps = 20;
/// The solver stops after two consecutive steps that leave more than this fraction of the largest residual.
constexpr double idle_ratio = 0.9;
/// Largest change of a control value in one step, fraction of the diagonal.
constexpr double longest_step = 0.25;

Eigen::Index rows_of(const Constraint& constraint) {
  return constraint.normal ? 1 : 3;
}

Eigen::Index rows_of(const std::vector<Constraint>& constraints) {
  Eigen::Index rows = 0;
  for (const Constraint& constraint : constraints) rows += rows_of(constraint);
  return rows;
}

Eigen::Quaterniond rotation_of(const Eigen::Vector3d& vector) {
  const double angle = vector.norm();
  return angle > 0 ? Eigen::Quaterniond(Eigen::AngleAxisd(angle, vector / angle))
                   : Eigen::Quaterniond::Identity();
}

/// Returns a solution x of A x = b for a positive semi-definite A that may be singular. Pivoted Cholesky
/// omits rows that depend on those before them.
Eigen::VectorXd semidefinite_solution(Eigen::MatrixXd a, const Eigen::VectorXd& b) {
  const Eigen::Index n = a.rows();
  const Eigen::VectorXd diagonal = a.diagonal();
  Eigen::VectorXd left = diagonal;
  Eigen::MatrixXd lower = Eigen::MatrixXd::Zero(n, n);
  std::vector<Eigen::Index> pivots;
  const double least = tolerance::redundant * (n > 0 ? diagonal.maxCoeff() : 0);
  for (Eigen::Index k = 0; k < n; ++k) {
    Eigen::Index pivot = 0;
    if (!(left.maxCoeff(&pivot) > least)) break;
    const double root = std::sqrt(left(pivot));
    lower.col(k).noalias() = (a.col(pivot) - lower.leftCols(k) * lower.row(pivot).head(k).transpose()) / root;
    left -= lower.col(k).cwiseAbs2();
    left(pivot) = 0;
    for (const Eigen::Index used : pivots) left(used) = 0;
    pivots.push_back(pivot);
  }
  const auto rank = static_cast<Eigen::Index>(pivots.size());
  Eigen::MatrixXd factor(rank, rank);
  Eigen::VectorXd solution(rank);
  for (Eigen::Index i = 0; i < rank; ++i) {
    factor.row(i) = lower.row(pivots[static_cast<std::size_t>(i)]).head(rank);
    solution(i) = b(pivots[static_cast<std::size_t>(i)]);
  }
  factor.triangularView<Eigen::Lower>().solveInPlace(solution);
  factor.triangularView<Eigen::Lower>().transpose().solveInPlace(solution);
  Eigen::VectorXd x = Eigen::VectorXd::Zero(n);
  for (Eigen::Index i = 0; i < rank; ++i) x(pivots[static_cast<std::size_t>(i)]) = solution(i);
  return x;
}

/// Returns what of a gap is beyond the slack of its constraint.
Eigen::Vector3d beyond_slack(const Eigen::Vector3d& gap, double slack) {
  const double length = gap.norm();
  if (slack == 0) return gap;
  return gap * (length > slack ? 1 - slack / length : 0);
}

/// Returns the directions in which a joint is held on its carrier. Precondition: it has one.
Eigen::Matrix3d held_at(const Rig& rig, const Constraint& constraint, const std::vector<Primitive>& now) {
  const int carrier = *constraint.carrier;
  const BoundPoint& on_carrier = *std::find_if(constraint.bound_points.begin(), constraint.bound_points.end(),
                                               [&](const BoundPoint& b) { return b.part == carrier; });
  const Eigen::Vector3d place =
      rig.primitive_bindings[at(carrier)].position_of(on_carrier.binding, now[at(carrier)]);
  return held_directions(now[at(carrier)], place, constraint.ways);
}

Eigen::VectorXd gaps(const Rig& rig, const std::vector<Constraint>& constraints, const SolverState& state,
                     const std::vector<Primitive>& now) {
  Eigen::VectorXd all(rows_of(constraints));
  Eigen::Index row = 0;
  for (const Constraint& constraint : constraints) {
    Eigen::Vector3d sum = -constraint.target;
    for (const BoundPoint& bound : constraint.bound_points)
      sum += bound.weight *
             rig.primitive_bindings[at(bound.part)].position_of(bound.binding, now[at(bound.part)]);
    if (constraint.normal) {
      all(row) = constraint.normal->dot(sum) - constraint.height -
                 (constraint.level ? state.levels(*constraint.level) : 0);
    } else {
      if (constraint.carrier) sum = held_at(rig, constraint, now) * sum;
      all.segment<3>(row) = beyond_slack(sum, constraint.slack);
    }
    row += rows_of(constraint);
  }
  return all;
}

class Solver {
 public:
  Solver(const Rig& rig, CorrectionSpace& corrections, const std::vector<Constraint>& constraints,
         SolverState start)
      : rig_(rig),
        corrections_(corrections),
        bases_(corrections.bases()),
        constraints_(constraints),
        state_(std::move(start)),
        active_(constraints.size(), 0) {
    for (const Eigen::MatrixXd& basis : bases_) {
      offsets_.push_back(columns_);
      columns_ += basis.cols();
    }
  }

  SolverState run() {
    double before = std::numeric_limits<double>::infinity();
    int idle = 0;
    for (int step = 0; step < max_steps; ++step) {
      now_ = rig_.space.primitives(state_.controls);
      const Eigen::VectorXd gap = gaps(rig_, constraints_, state_, now_);
      const double largest = gap.size() > 0 ? gap.cwiseAbs().maxCoeff() : 0;
      if (!(largest > tolerance::solve * rig_.rest.diagonal)) break;
      idle = largest > idle_ratio * before ? idle + 1 : 0;
      if (idle == 2) break;
      before = largest;
      activate(gap);
      // The Jacobian is sparse, because a joint depends on two classes only.
      const Eigen::SparseMatrix<double> jacobian = slopes().sparseView();
      Eigen::MatrixXd gram = jacobian * jacobian.transpose();
      advance(-jacobian.transpose() * semidefinite_solution(std::move(gram), gap));
    }
    return std::move(state_);
  }

 private:
  /// Lets constraints take part that have no slack or go beyond it.
  void activate(const Eigen::VectorXd& gap) {
    Eigen::Index row = 0;
    for (std::size_t k = 0; k < constraints_.size(); ++k) {
      const Eigen::Index rows = rows_of(constraints_[k]);
      if (constraints_[k].slack == 0 || !gap.segment(row, rows).isZero(0)) active_[k] = 1;
      row += rows;
    }
  }

  Eigen::MatrixXd slopes() const {
    Eigen::MatrixXd all = Eigen::MatrixXd::Zero(rows_of(constraints_), columns_ + state_.levels.size());
    const std::vector<Eigen::MatrixXd> turns = turn_columns();
    Eigen::Index row = 0;
    for (std::size_t k = 0; k < constraints_.size(); ++k) {
      const Constraint& constraint = constraints_[k];
      if (!active_[k]) {
        row += rows_of(constraint);
        continue;
      }
      const Eigen::Matrix3d held =
          constraint.carrier ? held_at(rig_, constraint, now_) : Eigen::Matrix3d::Identity();
      for (const BoundPoint& bound : constraint.bound_points) {
        const int c = rig_.space.class_of(bound.part);
        if (bases_[at(c)].cols() == 0) continue;
        const Eigen::MatrixXd slope = bound.weight * bound_point_slope(bound, turns[at(c)]);
        auto block = all.block(row, offsets_[at(c)], rows_of(constraint), slope.cols());
        if (constraint.normal)
          block += constraint.normal->transpose() * slope;
        else
          block += held * slope;
      }
      if (constraint.level) all(row, columns_ + *constraint.level) = -1;
      row += rows_of(constraint);
    }
    return all;
  }

  /// Returns, per class, the 3 x m rotation vectors of the columns; empty for cuboids.
  std::vector<Eigen::MatrixXd> turn_columns() const {
    std::vector<Eigen::MatrixXd> turns;
    for (std::size_t c = 0; c < bases_.size(); ++c) turns.push_back(turned_columns(c, bases_[c]));
    return turns;
  }

  Eigen::MatrixXd turned_columns(std::size_t c, const Eigen::MatrixXd& columns) const {
    const Eigen::MatrixXd& turning = rig_.turnings[c];
    if (turning.size() == 0 || columns.cols() == 0) return {};
    // `turning` was fitted at rest: rotate displacements back to rest, and the rotation vectors forward
    // again.
    const Eigen::Matrix3d rotation = state_.controls[c].rotation.toRotationMatrix();
    Eigen::MatrixXd found(3, turning.cols());
    for (Eigen::Index i = 0; i < turning.cols(); i += 3)
      found.middleCols<3>(i).noalias() = rotation * turning.middleCols<3>(i) * rotation.transpose();
    return found * columns.topRows(turning.cols());
  }

  Eigen::Matrix<double, 3, Eigen::Dynamic> bound_point_slope(const BoundPoint& bound,
                                                             const Eigen::MatrixXd& turns) const {
    const Eigen::MatrixXd& basis = bases_[at(rig_.space.class_of(bound.part))];
    const ControlJacobian jacobian =
        rig_.primitive_bindings[at(bound.part)].jacobian(bound.binding, now_[at(bound.part)]);
    Eigen::Matrix<double, 3, Eigen::Dynamic> slope =
        Eigen::Matrix<double, 3, Eigen::Dynamic>::Zero(3, basis.cols());
    for (const auto& [point, block] : jacobian.points)
      slope.noalias() += block * rig_.space.point_rows(bound.part, point, basis);
    for (const auto& [section, column] : jacobian.radii)
      slope.noalias() += column * rig_.space.radius_row(bound.part, section, basis);
    if (turns.size() > 0) slope.noalias() += jacobian.rotation * rig_.space.axial(bound.part) * turns;
    return slope;
  }

  void advance(const Eigen::VectorXd& step) {
    std::vector<Eigen::VectorXd> changes;
    double longest = 0;
    for (std::size_t c = 0; c < bases_.size(); ++c) {
      changes.push_back(bases_[c] * step.segment(offsets_[c], bases_[c].cols()));
      if (changes[c].size() > 0) longest = std::max(longest, changes[c].cwiseAbs().maxCoeff());
    }
    const double scale = std::min(1.0, longest_step * rig_.rest.diagonal / longest);
    for (std::size_t c = 0; c < bases_.size(); ++c) {
      if (bases_[c].cols() == 0) continue;
      ControlState& state = state_.controls[c];
      if (const Eigen::MatrixXd turn = turned_columns(c, changes[c]); turn.size() > 0)
        state.rotation = (rotation_of(scale * turn) * state.rotation).normalized();
      state.values += scale * changes[c];
    }
    state_.levels += scale * step.tail(state_.levels.size());
    corrections_.retract(state_.controls);
  }

  const Rig& rig_;
  CorrectionSpace& corrections_;
  const std::vector<Eigen::MatrixXd>& bases_;
  const std::vector<Constraint>& constraints_;
  SolverState state_;
  std::vector<char> active_;  ///< per constraint: whether it takes part
  std::vector<Primitive> now_;
  std::vector<Eigen::Index> offsets_;
  Eigen::Index columns_ = 0;
};

}  // namespace

std::vector<Constraint> joint_constraints(const Rig& rig) {
  std::vector<Constraint> constraints;
  for (const int k : rig.distinct_joints) {
    const JointPoint& joint = rig.joints[at(k)];
    Constraint constraint;
    const Eigen::Matrix3d whole = Eigen::Matrix3d::Identity();
    constraint.bound_points = {{joint.parts[0], joint.bindings[0], whole},
                               {joint.parts[1], joint.bindings[1], -whole}};
    const Relation& relation = rig.rest.relations[at(joint.relation)];
    if (relation.slides(joint.point)) {
      constraint.carrier = relation.carrier;
      constraint.ways = relation.sliding[at(joint.point)];
    }
    constraint.slack = relation.slack;
    constraints.push_back(std::move(constraint));
  }
  return constraints;
}

std::vector<Constraint> row_constraints(const Rig& rig) {
  std::vector<Constraint> constraints;
  for (const RowPoint& point : rig.row_points) {
    constexpr std::array<double, 3> weights = {1, -2, 1};  // the difference of the two steps
    Constraint constraint;
    for (std::size_t j = 0; j < weights.size(); ++j)
      constraint.bound_points.push_back(
          {point.parts[j], point.bindings[j], weights[j] * Eigen::Matrix3d::Identity()});
    constraints.push_back(std::move(constraint));
  }
  return constraints;
}

Eigen::VectorXd gaps(const Rig& rig, const std::vector<Constraint>& constraints, const SolverState& state) {
  return gaps(rig, constraints, state, rig.space.primitives(state.controls));
}

double largest_gap(const Rig& rig, const std::vector<Constraint>& constraints, const SolverState& state) {
  const Eigen::VectorXd all = gaps(rig, constraints, state);
  return all.size() > 0 ? all.cwiseAbs().maxCoeff() : 0;
}

SolverState solve_relations(const Rig& rig, CorrectionSpace& corrections,
                            const std::vector<Constraint>& constraints, SolverState start) {
  return Solver(rig, corrections, constraints, std::move(start)).run();
}

}  // namespace stackabilization::detail
