#include "deformation/controllers/edit_target.h"

#include <Eigen/QR>
#include <algorithm>
#include <cmath>

#include "core/index.h"
#include "deformation/controllers/reduced_basis.h"
#include "stackabilization/core/direction.h"
#include "stackabilization/core/tolerances.h"
#include "stackabilization/deformation/tolerances.h"

namespace stackabilization::detail {

namespace {

Eigen::MatrixXd pseudo_inverse(const Eigen::MatrixXd& matrix) {
  Eigen::CompleteOrthogonalDecomposition<Eigen::MatrixXd> solver;
  solver.setThreshold(tolerance::relative);
  solver.compute(matrix);
  return solver.pseudoInverse();
}

class EditTargetSolver {
 public:
  EditTargetSolver(const Rig& rig, const EditTargetTask& task)
      : rig_(rig),
        now_(task.now),
        start_(task.start),
        edit_(task.edit),
        constraints_(task.constraints),
        class_(rig.space.class_of(edit_.part)),
        state_(start_) {}

  EditTarget run() {
    if (auto refusal = whole() ? prescribe_whole() : prescribe_handle()) return {std::move(refusal), {}, {}};
    return {std::nullopt, std::move(state_), std::move(held_)};
  }

 private:
  bool whole() const { return static_cast<Eigen::Index>(edit_.values.size()) == state_.values.size(); }

  /// Returns the changes of the prescribed values of the edited part, one row each, for columns of changes of
  /// its class.
  Eigen::MatrixXd handle_rows(const Eigen::MatrixXd& columns) const {
    const auto count = static_cast<int>(3 * control_points(now_).rows());
    Eigen::MatrixXd rows(static_cast<Eigen::Index>(edit_.values.size()), columns.cols());
    for (std::size_t i = 0; i < edit_.values.size(); ++i) {
      const int value = edit_.values[i];
      const auto row = static_cast<Eigen::Index>(i);
      if (value < count)
        rows.row(row) = rig_.space.point_rows(edit_.part, value / 3, columns).row(value % 3);
      else
        rows.row(row) = rig_.space.radius_row(edit_.part, value - count, columns);
    }
    return rows;
  }

  std::optional<Refusal> prescribe_whole() {
    const ControlState wanted = rig_.space.state_of(edit_.part, changed(now_, edit_));
    state_ = rig_.space.invariant(class_, wanted);
    const double miss = (wanted.values - state_.values).cwiseAbs().maxCoeff() / rig_.rest.diagonal;
    const double turn = wanted.rotation.angularDistance(state_.rotation);
    if (miss > tolerance::relative) return missed(RefusalCause::symmetry, miss);
    if (turn > tolerance::relation) return missed(RefusalCause::symmetry_of_turn, turn);
    if (edit_.leans) held_ = held(all_rows());
    return std::nullopt;
  }

  std::optional<Refusal> prescribe_handle() {
    const Eigen::MatrixXd spread = edit_.linear_from ? linear_spread(*edit_.linear_from)
                                                     : handle_rows(rig_.edit_kernels[at(class_)]).transpose();
    const Eigen::VectorXd change = spread * (pseudo_inverse(handle_rows(spread)) * edit_.changes);
    const double miss = (handle_rows(change) - edit_.changes).cwiseAbs().maxCoeff() / rig_.rest.diagonal;
    if (miss > tolerance::relative) return missed(RefusalCause::symmetry, miss);
    state_.values += change;
    held_ = held(all_rows());
    return std::nullopt;
  }

  Eigen::MatrixXd all_rows() const {
    return handle_rows(Eigen::MatrixXd::Identity(state_.values.size(), state_.values.size()));
  }

  /// Returns the columns of the kernel W W^T of the linear falloff that belong to the handle. W holds three
  /// displacements and a change of radii, each in proportion to the linear weights, projected to the subspace
  /// of the self-symmetries.
  Eigen::MatrixXd linear_spread(int section) const {
    const Eigen::VectorXd weights = linear_weights(std::get<GeneralizedCylinder>(now_), section);
    const auto n = static_cast<int>(weights.size());
    Eigen::MatrixXd changes = Eigen::MatrixXd::Zero(4 * n, 4);
    for (int i = 0; i < n; ++i) {
      const int k = rig_.space.counterpart(edit_.part, i);
      changes.block<3, 3>(3 * k, 0) = weights(i) * Eigen::Matrix3d::Identity();
      changes(3 * n + k, 3) = weights(i);
    }
    changes = rig_.space.invariant_columns(class_, changes);
    return changes * handle_rows(changes).transpose();
  }

  /// Returns the rows that corrections must not change: all rows of the prescribed values. With fixed ends of
  /// an extent, a move or leaning across it leaves the heights free, since a leaning foot must give way to
  /// stay on the ground: then only the components across the extent, and the radii.
  Eigen::MatrixXd held(const Eigen::MatrixXd& rows) const {
    if (!constraints_.keep_extent || constraints_.extent_ends != ExtentEnds::fixed) return rows;
    const auto coordinates = static_cast<int>(3 * control_points(now_).rows());
    const Eigen::Index points =
        std::count_if(edit_.values.begin(), edit_.values.end(), [&](int v) { return v < coordinates; }) / 3;
    const Frame frame = frame_of(*constraints_.keep_extent);
    const Eigen::Index radii = rows.rows() - 3 * points;
    Eigen::MatrixXd across(2 * points + radii, rows.cols());
    across.bottomRows(radii) = rows.bottomRows(radii);
    for (Eigen::Index k = 0; k < points; ++k) {
      const Eigen::Vector3d by = edit_.changes.segment<3>(3 * k);
      if (std::abs(by.dot(frame.w)) > tolerance::relative * by.norm()) return rows;
      across.row(2 * k) = frame.u.transpose() * rows.middleRows<3>(3 * k);
      across.row(2 * k + 1) = frame.v.transpose() * rows.middleRows<3>(3 * k);
    }
    return across;
  }

  Refusal missed(RefusalCause cause, double amount) const {
    return {.cause = cause, .part = edit_.part, .relation = contradicting_relation(), .amount = amount};
  }

  /// Returns the symmetry of the edited class that the prescription violates most; -1: none.
  int contradicting_relation() const {
    const ControlState wanted = rig_.space.state_of(edit_.part, changed(now_, edit_));
    const Eigen::VectorXd change = wanted.values - start_.values;
    const auto& stabilisers = rig_.space.stabilisers(class_);
    int worst = -1;
    if (!stabilisers.empty()) worst = stabilisers.front().relation;
    double most = 0;
    for (const ControlSpace::Stabiliser& g : stabilisers)
      for (std::size_t i = 0; i < g.order.size(); ++i) {
        const Eigen::Vector3d move = change.segment<3>(static_cast<Eigen::Index>(3 * i));
        const Eigen::Vector3d image = change.segment<3>(3 * g.order[i]);
        const bool both = !move.isZero(0) && !image.isZero(0);
        const double gap = both ? (g.linear * move - image).norm() : 0;
        if (gap > most) most = gap, worst = g.relation;
      }
    return worst;
  }

  const Rig& rig_;
  const Primitive& now_;
  const ControlState& start_;
  const PartEdit& edit_;
  const DeformationConstraints& constraints_;
  int class_;
  ControlState state_;
  std::optional<Eigen::MatrixXd> held_;
};

}  // namespace

EditTarget edit_target(const Rig& rig, const EditTargetTask& task) {
  return EditTargetSolver(rig, task).run();
}

}  // namespace stackabilization::detail
