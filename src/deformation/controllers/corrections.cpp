#include "deformation/controllers/corrections.h"

#include <Eigen/QR>
#include <utility>

#include "core/index.h"
#include "deformation/model/straight_curve.h"
#include "stackabilization/core/tolerances.h"

namespace stackabilization::detail {

namespace {

/// Column scale of the corrections that the edit leaves to the part of its handle, relative to other parts:
/// this part resists corrections.
constexpr double stiffness = 0.3;

/// Returns the orthogonal projector onto the space that the rows span.
Eigen::MatrixXd row_space(const Eigen::MatrixXd& rows) {
  Eigen::CompleteOrthogonalDecomposition<Eigen::MatrixXd> solver;
  solver.setThreshold(tolerance::relative);
  solver.compute(rows);
  return solver.pseudoInverse() * rows;
}

}  // namespace

CorrectionSpace::CorrectionSpace(const Rig& rig, const std::vector<Eigen::MatrixXd>& bases)
    : rig_(rig), bases_(bases), straight_(bases.size()) {}

void CorrectionSpace::fix(int of_class) {
  bases_[at(of_class)].resize(bases_[at(of_class)].rows(), 0);
}

void CorrectionSpace::hold(const PartEdit& edit, Eigen::MatrixXd rows) {
  held_ = Held{edit, std::move(rows)};
  const int c = rig_.space.class_of(edit.part);
  allow(c, Eigen::MatrixXd(bases_[at(c)]));
}

void CorrectionSpace::allow(int of_class, const Eigen::MatrixXd& columns) {
  Eigen::MatrixXd& basis = bases_[at(of_class)];
  basis = columns;
  if (!held_ || rig_.space.class_of(held_->edit.part) != of_class) return;
  basis = stiffness * (columns - columns * row_space(held_->rows * columns));
}

StraightHandle CorrectionSpace::handle_in(int of_class) const {
  StraightHandle handle;
  if (!held_ || rig_.space.class_of(held_->edit.part) != of_class) return handle;
  const int part = held_->edit.part, value = held_->edit.values.front();
  const auto count = static_cast<int>(control_points(rig_.space.rest(part)).rows());
  if (value < 3 * count)
    handle.section = rig_.space.counterpart(part, value / 3);
  else
    handle.radius = rig_.space.counterpart(part, value - 3 * count);
  return handle;
}

void CorrectionSpace::keep_straight(const std::vector<ControlState>& states) {
  start_ = states;
  for (int c = 0; c < rig_.space.class_count(); ++c) {
    const Primitive now = rig_.space.primitive(rig_.space.members(c).front(), states[at(c)]);
    const auto* cylinder = std::get_if<GeneralizedCylinder>(&now);
    if (cylinder == nullptr || is_fixed(c) || !is_straight(*cylinder)) continue;
    straight_[at(c)].emplace(*cylinder, rig_.slides[at(c)], rig_.strains[at(c)], handle_in(c));
    allow(c, rig_.space.invariant_columns(c, straight_[at(c)]->columns(*cylinder)));
  }
}

void CorrectionSpace::retract(std::vector<ControlState>& states) {
  for (int c = 0; c < rig_.space.class_count(); ++c) {
    ControlState& state = states[at(c)];
    if (!straight_[at(c)] || state.values == start_[at(c)].values) continue;
    const int first = rig_.space.members(c).front();
    const auto now =
        straight_[at(c)]->retract(std::get<GeneralizedCylinder>(rig_.space.primitive(first, state)));
    ControlState settled = rig_.space.state_of(first, now);
    settled.rotation = state.rotation;
    state = rig_.space.invariant(c, std::move(settled));
    allow(c, rig_.space.invariant_columns(c, straight_[at(c)]->columns(now)));
  }
}

}  // namespace stackabilization::detail
