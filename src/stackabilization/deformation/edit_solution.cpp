#include "stackabilization/deformation/edit_solution.h"

#include <Eigen/QR>
#include <algorithm>
#include <charconv>
#include <cmath>

#include "stackabilization/deformation/correction_basis.h"
#include "stackabilization/deformation/primitive_validity.h"
#include "stackabilization/deformation/propagation.h"
#include "stackabilization/deformation/relation_residual.h"
#include "stackabilization/shape/errors.h"
#include "stackabilization/shape/tolerances.h"

namespace stackabilization::detail {

namespace {

/// How much the part that carries the handle resists corrections of what the edit left open of it: length of
/// its columns relative to those of other parts.
constexpr double stiffness = 0.3;
/// Rounds in which vertices that a solve made outermost are held as well.
constexpr int extent_rounds = 10;

std::size_t at(int i) {
  return static_cast<std::size_t>(i);
}

std::string fraction(double value) {
  char buffer[32];
  const auto end = std::to_chars(buffer, buffer + sizeof buffer, value, std::chars_format::general, 3).ptr;
  return {buffer, end};
}

std::string name_of(const Relation& relation, const Structure& structure) {
  std::string name =
      "the " + name_of(relation.type) + " of '" + structure.parts[at(relation.parts.front())].name + "'";
  if (relation.parts.size() > 1) name += " and '" + structure.parts[at(relation.parts.back())].name + "'";
  return name;
}

Eigen::MatrixXd pseudo_inverse(const Eigen::MatrixXd& matrix) {
  Eigen::CompleteOrthogonalDecomposition<Eigen::MatrixXd> solver;
  solver.setThreshold(tolerance::relative);
  solver.compute(matrix);
  return solver.pseudoInverse();
}

/// `primitive` with its control values changed, and turned where it can be.
Primitive changed(Primitive primitive, const PartEdit& edit) {
  const auto change = [&](auto& points, Eigen::VectorXd* radii) {
    const auto count = static_cast<int>(3 * points.rows());
    for (std::size_t i = 0; i < edit.values.size(); ++i) {
      const int value = edit.values[i];
      const double by = edit.changes(static_cast<Eigen::Index>(i));
      if (value < count)
        points(value / 3, value % 3) += by;
      else
        (*radii)(value - count) += by;
    }
  };
  if (auto* cuboid = std::get_if<Cuboid>(&primitive)) {
    change(cuboid->corners, nullptr);
  } else {
    auto& cylinder = std::get<GeneralizedCylinder>(primitive);
    change(cylinder.centres, &cylinder.radii);
    cylinder.rotation = edit.rotation * cylinder.rotation;
  }
  return primitive;
}

bool changes_nothing(const PartEdit& edit) {
  return edit.changes.isZero(0) && edit.rotation.vec().isZero(0);
}

class EditSolution {
 public:
  EditSolution(const Rig& rig, const RiggedMesh& mesh, const EditTask& task)
      : rig_(rig),
        mesh_(mesh),
        task_(task),
        edit_(task.wanted.front()),
        class_(rig.space.class_of(edit_.part)),
        progress_(at(rig.space.class_count()), Progress::open),
        bases_(rig.bases),
        watch_(mesh.by_part, extent_bounds(task.shape, task.constraints)) {}

  EditOutcome run() {
    fix_parts();
    if (std::all_of(task_.wanted.begin(), task_.wanted.end(), changes_nothing))
      return {std::nullopt, task_.now};
    start_ = rig_.space.states(task_.now);
    state_.controls = start_;
    if (task_.wanted.size() > 1) {
      if (auto refusal = prescribe_all()) return refused(std::move(*refusal));
    } else {
      if (auto refusal = prescribe()) return refused(std::move(*refusal));
      progress_[at(class_)] = Progress::modified;
      state_.controls = propagated(rig_, std::move(state_.controls), progress_);
    }
    solve();
    primitives_ = current_primitives();
    if (auto refusal = broken()) return refused(std::move(*refusal));
    return {std::nullopt, std::move(primitives_)};
  }

 private:
  EditOutcome refused(Refusal refusal) const { return {std::move(refusal), task_.now}; }

  double diagonal() const { return rig_.rest.diagonal; }

  const std::string& part_name(int part) const { return rig_.rest.parts[at(part)].name; }

  void fix_parts() {
    for (const int part : task_.constraints.fixed_parts) {
      if (part < 0 || at(part) >= rig_.rest.parts.size())
        throw UsageError("there is no part " + std::to_string(part) + " to fix");
      const int c = rig_.space.class_of(part);
      progress_[at(c)] = Progress::settled;
      bases_[at(c)].resize(bases_[at(c)].rows(), 0);
    }
  }

  /// Rows of the prescribed values of the edited part, given columns of changes of its class.
  Eigen::MatrixXd handle_rows(const Eigen::MatrixXd& columns) const {
    const auto count = static_cast<int>(3 * control_points(task_.now[at(edit_.part)]).rows());
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

  bool whole() const { return static_cast<Eigen::Index>(edit_.values.size()) == bases_[at(class_)].rows(); }

  /// Gives the edited class what the edit prescribes, within its symmetries, and leaves its basis what keeps
  /// that.
  std::optional<Refusal> prescribe() {
    if (progress_[at(class_)] == Progress::settled)
      return Refusal{"'" + part_name(edit_.part) + "' is fixed, or symmetric to a part that is", std::nullopt,
                     0};
    return whole() ? prescribe_whole() : prescribe_handle();
  }

  /// Gives every part what the edit prescribes, as far as all symmetries allow that.
  std::optional<Refusal> prescribe_all() {
    std::vector<Primitive> wanted;
    for (const PartEdit& edit : task_.wanted) {
      if (progress_[at(rig_.space.class_of(edit.part))] == Progress::settled)
        return Refusal{"'" + part_name(edit.part) + "' is fixed, or symmetric to a part that is",
                       std::nullopt, 0};
      wanted.push_back(changed(task_.now[at(edit.part)], edit));
    }
    const std::vector<double> residuals = relation_residuals(rig_.rest, wanted);
    for (std::size_t row = 0; row < residuals.size(); ++row) {
      const Relation& relation = rig_.rest.relations[row];
      const bool symmetry =
          relation.type == RelationType::symmetry || relation.type == RelationType::self_symmetry;
      if (symmetry && residuals[row] > tolerance::relation)
        return Refusal{name_of(relation, rig_.rest) + " does not let the shape go where the edit takes it: " +
                           "it would be off by " + fraction(residuals[row]) + " of the diagonal",
                       static_cast<int>(row), residuals[row]};
    }
    state_.controls = rig_.space.states(wanted);
    return std::nullopt;
  }

  std::optional<Refusal> prescribe_whole() {
    const ControlState wanted = rig_.space.state_of(edit_.part, changed(task_.now[at(edit_.part)], edit_));
    ControlState& state = state_.controls[at(class_)];
    state = rig_.space.invariant(class_, wanted);
    bases_[at(class_)].resize(bases_[at(class_)].rows(), 0);
    const double miss = (wanted.values - state.values).cwiseAbs().maxCoeff() / diagonal();
    const double turn = wanted.rotation.angularDistance(state.rotation);
    if (miss > tolerance::relative) return missed(miss, "of the diagonal");
    if (turn > tolerance::relation) return missed(turn, "radians");
    return std::nullopt;
  }

  std::optional<Refusal> prescribe_handle() {
    const Eigen::MatrixXd spread = edit_.linear_from ? linear_spread(*edit_.linear_from)
                                                     : handle_rows(rig_.edit_kernels[at(class_)]).transpose();
    const Eigen::VectorXd change = spread * (pseudo_inverse(handle_rows(spread)) * edit_.changes);
    const double miss = (handle_rows(change) - edit_.changes).cwiseAbs().maxCoeff() / diagonal();
    if (miss > tolerance::relative) return missed(miss, "of the diagonal");
    state_.controls[at(class_)].values += change;
    Eigen::MatrixXd& basis = bases_[at(class_)];
    const Eigen::MatrixXd rows = held(handle_rows(basis));
    basis = stiffness * (basis - basis * (pseudo_inverse(rows) * rows));
    return std::nullopt;
  }

  /// As the columns of an edit kernel that belong to the handle, of W W^T: W holds three moves and a change
  /// of radii, each in proportion to the linear weights, within what the self-symmetries leave free.
  Eigen::MatrixXd linear_spread(int section) const {
    const auto& rest = std::get<GeneralizedCylinder>(rig_.space.rest(edit_.part));
    const Eigen::VectorXd weights = linear_weights(rest, section);
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

  /// What corrections must leave alone of the rows of the prescribed values: all; but where the ends of an
  /// extent are fixed, a move across it says nothing about heights, and a foot that leans has to give way to
  /// stay on the ground.
  Eigen::MatrixXd held(const Eigen::MatrixXd& rows) const {
    const DeformationConstraints& constraints = task_.constraints;
    const auto points = static_cast<Eigen::Index>(edit_.values.size()) / 3;
    if (!constraints.keep_extent || constraints.extent_ends != ExtentEnds::fixed || 3 * points != rows.rows())
      return rows;
    const Frame frame = frame_of(*constraints.keep_extent);
    Eigen::MatrixXd across(2 * points, rows.cols());
    for (Eigen::Index k = 0; k < points; ++k) {
      const auto first = static_cast<std::size_t>(3 * k);
      const bool is_point =
          edit_.values[first] % 3 == 0 && edit_.values[first + 2] == edit_.values[first] + 2;
      const Eigen::Vector3d by = edit_.changes.segment<3>(3 * k);
      if (!is_point || std::abs(by.dot(frame.w)) > tolerance::relative * by.norm()) return rows;
      across.row(2 * k) = frame.u.transpose() * rows.middleRows<3>(3 * k);
      across.row(2 * k + 1) = frame.v.transpose() * rows.middleRows<3>(3 * k);
    }
    return across;
  }

  Refusal missed(double amount, const std::string& unit) const {
    const std::optional<int> relation = contradicting_relation();
    const std::string cause = relation ? name_of(rig_.rest.relations[at(*relation)], rig_.rest) : "rounding";
    return {cause + " does not let '" + part_name(edit_.part) +
                "' go where the edit takes it: it would miss by " + fraction(amount) + " " + unit,
            relation, amount};
  }

  /// The symmetry of the edited class that what is prescribed contradicts most.
  std::optional<int> contradicting_relation() const {
    const ControlState wanted = rig_.space.state_of(edit_.part, changed(task_.now[at(edit_.part)], edit_));
    const Eigen::VectorXd change = wanted.values - start_[at(class_)].values;
    const auto& stabilisers = rig_.space.stabilisers(class_);
    std::optional<int> worst;
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

  void solve() {
    std::vector<Constraint> constraints = joint_constraints(rig_);
    for (const Constraint& fixed : fixed_point_constraints()) constraints.push_back(fixed);
    fixed_points_ = {constraints.begin() + static_cast<std::ptrdiff_t>(rig_.distinct_joints.size()),
                     constraints.end()};
    state_ = solved(rig_, bases_, constraints, std::move(state_));
    if (watch_.bounds().empty() || largest_gap(rig_, constraints, state_) > tolerance::relation * diagonal())
      return;
    const SolverState unbounded = state_;
    bound_extents(constraints);
    // Relations give way when bounds cannot be met: then the bounds are what is to be reported.
    if (!(largest_gap(rig_, constraints, state_) <= tolerance::relation * diagonal())) state_ = unbounded;
  }

  /// Holds the outermost vertices. Those found one after the other are held together at first; where that
  /// contradicts itself, as on a face that the edit tilts by a hair, only those of the last round.
  void bound_extents(std::vector<Constraint>& constraints) {
    const std::vector<Constraint> unbounded = constraints;
    for (int round = 0; round < 2 * extent_rounds; ++round) {
      const Points vertices = mesh_.transfer.vertices(rig_, rig_.space.primitives(state_.controls));
      if (state_.levels.size() == 0) state_.levels = watch_.levels(vertices);
      if (!watch_.any_excess(vertices)) return;
      if (round >= extent_rounds) {
        constraints = unbounded;
        watch_.release();
      }
      bool held = false;
      for (std::size_t k = 0; k < watch_.bounds().size(); ++k)
        if (watch_.excess(k, vertices) != 0 || (round >= extent_rounds && watch_.is_kept(k)))
          held |= watch_.hold(k, vertices, mesh_.transfer, constraints);
      if (held)
        state_ = solved(rig_, bases_, constraints, std::move(state_));
      else
        round = std::max(round, extent_rounds - 1);
    }
  }

  /// The points of the surface nearest to the fixed ones stay where they are now.
  std::vector<Constraint> fixed_point_constraints() const {
    std::vector<Constraint> constraints;
    for (const Eigen::Vector3d& point : task_.constraints.fixed_points) {
      if (!point.allFinite()) throw UsageError("a point to be fixed must be finite");
      const SurfacePoint nearest = mesh_.surface.nearest(point);
      Eigen::Matrix3d corners;
      for (int k = 0; k < 3; ++k) corners.col(k) = task_.shape.corner(nearest.triangle, k);
      const Eigen::Vector3d weights = barycentric(corners, nearest.point);
      Constraint constraint;
      for (int k = 0; k < 3; ++k)
        for (Rider rider : mesh_.transfer.riders(task_.shape.triangles(nearest.triangle, k))) {
          rider.weight *= weights(k);
          constraint.target +=
              rider.weight * rig_.carriers[at(rider.part)].carried(rider.binding, task_.now[at(rider.part)]);
          constraint.riders.push_back(std::move(rider));
        }
      constraints.push_back(std::move(constraint));
    }
    return constraints;
  }

  static Eigen::Vector3d barycentric(const Eigen::Matrix3d& corners, const Eigen::Vector3d& point) {
    Eigen::Matrix<double, 3, 2> edges;
    edges << corners.col(1) - corners.col(0), corners.col(2) - corners.col(0);
    const Eigen::Vector2d weights = edges.completeOrthogonalDecomposition().solve(point - corners.col(0));
    return {1 - weights.sum(), weights(0), weights(1)};
  }

  /// Classes that nothing moved keep the very numbers they had.
  std::vector<Primitive> current_primitives() const {
    std::vector<Primitive> primitives = rig_.space.primitives(state_.controls);
    for (std::size_t part = 0; part < primitives.size(); ++part) {
      const std::size_t c = at(rig_.space.class_of(static_cast<int>(part)));
      const ControlState &before = start_[c], &after = state_.controls[c];
      if (before.values == after.values && before.rotation.coeffs() == after.rotation.coeffs())
        primitives[part] = task_.now[part];
    }
    return primitives;
  }

  std::optional<Refusal> broken() const {
    if (auto refusal = broken_relation()) return refusal;
    for (std::size_t part = 0; part < primitives_.size(); ++part)
      if (const auto what = defect(rig_.rest.parts[part].primitive, primitives_[part]))
        return Refusal{"'" + rig_.rest.parts[part].name + "' " + *what, std::nullopt, 0};
    if (const double gap = largest_gap(rig_, fixed_points_, state_) / diagonal();
        !(gap <= tolerance::relation))
      return Refusal{"a fixed point would move by " + fraction(gap) + " of the diagonal", std::nullopt, gap};
    return broken_extent();
  }

  std::optional<Refusal> broken_relation() const {
    const std::vector<double> residuals = relation_residuals(rig_.rest, primitives_);
    const auto worst = std::max_element(residuals.begin(), residuals.end());
    if (worst == residuals.end() || !(*worst > tolerance::relation)) return std::nullopt;
    const auto row = static_cast<int>(worst - residuals.begin());
    const Relation& relation = rig_.rest.relations[at(row)];
    return Refusal{name_of(relation, rig_.rest) + " would be off by " + fraction(*worst) + " of the diagonal",
                   row, *worst};
  }

  std::optional<Refusal> broken_extent() const {
    if (watch_.bounds().empty()) return std::nullopt;
    const Points vertices = mesh_.transfer.vertices(rig_, primitives_);
    for (std::size_t k = 0; k < watch_.bounds().size(); ++k) {
      const double excess = watch_.excess(k, vertices);
      if (excess == 0) continue;
      const Eigen::Vector3d& n = watch_.bounds()[k].normal;
      const std::string what = watch_.bounds()[k].level ? ") would begin or end elsewhere, off by "
                               : excess > 0             ? ") would be too long by "
                                                        : ") would be too short by ";
      return Refusal{"the extent along (" + fraction(n.x()) + ", " + fraction(n.y()) + ", " +
                         fraction(n.z()) + what + fraction(std::abs(excess) / diagonal()) +
                         " of the diagonal",
                     std::nullopt, std::abs(excess) / diagonal()};
    }
    return std::nullopt;
  }

  const Rig& rig_;
  const RiggedMesh& mesh_;
  const EditTask& task_;
  const PartEdit& edit_;  ///< the one of a handle
  int class_;
  std::vector<Progress> progress_;  ///< per class
  std::vector<Eigen::MatrixXd> bases_;
  ExtentWatch watch_;
  std::vector<ControlState> start_;
  SolverState state_;
  std::vector<Constraint> fixed_points_;
  std::vector<Primitive> primitives_;
};

}  // namespace

EditOutcome solved_edit(const Rig& rig, const RiggedMesh& mesh, const EditTask& task) {
  return EditSolution(rig, mesh, task).run();
}

}  // namespace stackabilization::detail
