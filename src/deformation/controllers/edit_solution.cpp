#include "deformation/controllers/edit_solution.h"

#include <Eigen/QR>
#include <algorithm>
#include <cmath>
#include <set>
#include <variant>

#include "core/index.h"
#include "deformation/controllers/corrections.h"
#include "deformation/controllers/edit_target.h"
#include "deformation/controllers/primitive_validity.h"
#include "deformation/controllers/propagation.h"
#include "mesh/barycentric.h"
#include "stackabilization/core/errors.h"
#include "stackabilization/deformation/relation_residual.h"
#include "stackabilization/deformation/tolerances.h"

namespace stackabilization::detail {

namespace {

/// Largest number of rounds that additionally hold the vertices which a solve made outermost.
constexpr int extent_rounds = 10;

/// Largest number of rounds of stretching that remove the residual of an extent. The two limits of the
/// residual are multiples of tolerance::relation: rounds of holding vertices go on while it exceeds the
/// first, and stretching removes at most the second.
constexpr int remainder_rounds = 4;
constexpr double settled_remainder = 0.1, largest_remainder = 10;

/// Largest distance of a taper from a symmetry of a part that it is made to have, fraction of the diagonal.
/// Parts of real objects are symmetric to planes that miss those of the whole by a little.
constexpr double taper_symmetry = 0.002;

/// Farthest that a control point of a part goes across its move when the part gives way, fraction of the
/// move. What would have to go farther, as along members that the move hardly crosses, is moved together with
/// its neighbours.
constexpr double farthest_aside = 0.5;

bool changes_nothing(const PartEdit& edit) {
  return edit.changes.isZero(0) && edit.rotation.vec().isZero(0);
}

/// Returns how much a primitive that moved differs from one that moved as a whole: the largest distance of
/// control points, and change of radii.
double distance_aside(const Primitive& before, const Primitive& after, const Eigen::Vector3d& by) {
  const Points moved = control_points(after) - control_points(before);
  double farthest = (moved.rowwise() - by.transpose()).rowwise().norm().maxCoeff();
  if (const auto* cylinder = std::get_if<GeneralizedCylinder>(&before))
    farthest = std::max(farthest,
                        (std::get<GeneralizedCylinder>(after).radii - cylinder->radii).cwiseAbs().maxCoeff());
  return farthest;
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
        corrections_(rig, task.is_taper ? rig.free_bases : rig.bases),
        extents_(mesh.by_class, extent_bounds(task.shape, task.constraints)) {}

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
      if (task_.gives_way && give_way()) return finished();
      progress_[at(class_)] = Progress::modified;
      // With fixed ends of an extent, the moved part must not move all others along.
      if (task_.constraints.extent_ends == ExtentEnds::free)
        state_.controls = propagate(rig_, std::move(state_.controls), progress_);
    }
    corrections_.keep_straight(state_.controls);
    solve();
    return finished();
  }

 private:
  EditOutcome refused(Refusal refusal) const { return {std::move(refusal), task_.now}; }

  EditOutcome finished() {
    take_up_remainder();
    primitives_ = current_primitives();
    if (auto refusal = broken()) return refused(std::move(*refusal));
    return {std::nullopt, std::move(primitives_)};
  }

  double diagonal() const { return rig_.rest.diagonal; }

  void fix_parts() {
    for (const int part : task_.constraints.fixed_parts) {
      const int c = rig_.space.class_of(part);
      progress_[at(c)] = Progress::settled;
      corrections_.fix(c);
    }
  }

  /// Gives the edited class the state that the edit prescribes, within its symmetries, and restricts
  /// corrections to those that keep it.
  std::optional<Refusal> prescribe() {
    if (progress_[at(class_)] == Progress::settled)
      return Refusal{.cause = RefusalCause::fixed_part, .part = edit_.part};
    EditTarget wanted =
        edit_target(rig_, {task_.now[at(edit_.part)], start_[at(class_)], edit_, task_.constraints});
    if (wanted.refusal) return std::move(wanted.refusal);
    state_.controls[at(class_)] = std::move(wanted.state);
    if (wanted.held)
      corrections_.hold(edit_, std::move(*wanted.held));
    else
      corrections_.fix(class_);
    return std::nullopt;
  }

  /// Gives every part the state that the edit prescribes. Refuses when this violates a symmetry.
  std::optional<Refusal> prescribe_all() {
    std::vector<Primitive> wanted;
    for (const PartEdit& edit : task_.wanted) {
      if (progress_[at(rig_.space.class_of(edit.part))] == Progress::settled)
        return Refusal{.cause = RefusalCause::fixed_part, .part = edit.part};
      wanted.push_back(changed(task_.now[at(edit.part)], edit));
    }
    const std::vector<double> residuals = relation_residuals(rig_.rest, wanted);
    for (std::size_t row = 0; row < residuals.size(); ++row) {
      const RelationType type = rig_.rest.relations[row].type;
      const bool symmetry = type == RelationType::symmetry || type == RelationType::self_symmetry;
      if (symmetry && residuals[row] > (task_.is_taper ? taper_symmetry : tolerance::relation))
        return Refusal{.cause = RefusalCause::symmetry_of_shape,
                       .relation = static_cast<int>(row),
                       .amount = residuals[row]};
    }
    state_.controls = rig_.space.states(wanted);
    return std::nullopt;
  }

  /// Returns the constraints of joints, rows and fixed points.
  std::vector<Constraint> given_constraints() {
    std::vector<Constraint> constraints = joint_constraints(rig_);
    for (Constraint& constraint : row_constraints(rig_)) constraints.push_back(std::move(constraint));
    fixed_points_ = fixed_point_constraints();
    constraints.insert(constraints.end(), fixed_points_.begin(), fixed_points_.end());
    return constraints;
  }

  /// Closes the joints of the moved part by changes of it across the move alone; the parts of its rows come
  /// along. Returns false, and changes nothing, when this is not enough.
  bool give_way() {
    CorrectionSpace corrections(rig_, rig_.bases);
    const std::set<int> yielding = classes_of_rows();
    for (int c = 0; c < rig_.space.class_count(); ++c)
      if (!yielding.contains(c) || (c != class_ && corrections_.is_fixed(c))) corrections.fix(c);
    const Eigen::Vector3d by = edit_.changes.head<3>(), along = by.normalized();
    const Eigen::Index values = start_[at(class_)].values.size();
    const auto points = static_cast<int>(control_points(task_.now[at(edit_.part)]).rows());
    Eigen::MatrixXd heights(points, values);
    for (int i = 0; i < points; ++i)
      heights.row(i) =
          along.transpose() * rig_.space.point_rows(edit_.part, i, Eigen::MatrixXd::Identity(values, values));
    corrections.hold(edit_, std::move(heights));
    const SolverState prescribed = state_;
    corrections.keep_straight(state_.controls);
    const std::vector<Constraint> constraints = given_constraints();
    state_ = solve_relations(rig_, corrections, constraints, std::move(state_));
    const double aside = distance_aside(task_.now[at(edit_.part)],
                                        rig_.space.primitive(edit_.part, state_.controls[at(class_)]), by);
    const bool closed = largest_gap(rig_, constraints, state_) <= tolerance::relation * diagonal(),
               near = aside <= farthest_aside * by.norm();
    if (closed && near && remains_at_most(settled_remainder, current_vertices())) return true;
    state_ = prescribed;
    return false;
  }

  /// Returns the edited class, and those that share a row with it, with these, and so on.
  std::set<int> classes_of_rows() const {
    std::set<int> found = {class_};
    for (std::size_t known = 0; known < found.size();) {
      known = found.size();
      for (const RowPoint& point : rig_.row_points) {
        std::set<int> classes;
        for (const int part : point.parts) classes.insert(rig_.space.class_of(part));
        if (std::any_of(classes.begin(), classes.end(), [&](int c) { return found.contains(c); }))
          found.merge(classes);
      }
    }
    return found;
  }

  void solve() {
    const std::vector<Constraint> constraints = given_constraints();
    if (!solve_with_fixed_ends(constraints))
      state_ = solve_relations(rig_, corrections_, constraints, std::move(state_));
    if (extents_.bounds().empty() ||
        largest_gap(rig_, constraints, state_) > tolerance::relation * diagonal())
      return;
    const SolverState unbounded = state_;
    bound_extents(constraints);
    // Bounds that cannot be met violate relations. Return to the state without bounds then, so that the
    // refusal names the bounds.
    if (!(largest_gap(rig_, constraints, state_) <= tolerance::relation * diagonal())) state_ = unbounded;
  }

  /// Solves with the vertices at the fixed ends of an extent held from the start. Otherwise the joints first
  /// move all parts along, and the vertices that pass the ends then are not those that must stay on them.
  /// Returns false, and changes nothing, when there is nothing to hold, or when it cannot be held together
  /// with `constraints`.
  bool solve_with_fixed_ends(const std::vector<Constraint>& constraints) {
    const bool fixed = std::any_of(extents_.bounds().begin(), extents_.bounds().end(),
                                   [](const ExtentBound& bound) { return bound.level.has_value(); });
    if (!fixed) return false;
    const SolverState prescribed = state_;
    const Points vertices = current_vertices();
    state_.levels = extents_.levels(vertices);
    bool held = false;
    for (std::size_t k = 0; k < extents_.bounds().size(); ++k)
      if (extents_.bounds()[k].level)
        held |= extents_.hold(k, vertices, ActiveExtentConstraints::OnExchange::keep);
    if (held) {
      const std::vector<Constraint> all = solve_held(constraints);
      if (largest_gap(rig_, all, state_) <= tolerance::relation * diagonal()) return true;
    }
    extents_.release();
    state_ = prescribed;
    corrections_.keep_straight(state_.controls);
    return false;
  }

  /// Holds the outermost vertices in three stages. First, one vertex per class: another vertex that becomes
  /// outermost replaces it. Second, all of these vertices, when they take turns. Third, only the vertices
  /// that are outermost in a class now, when earlier ones are in the way, as on a face that the edit tilts by
  /// a very small angle.
  void bound_extents(const std::vector<Constraint>& constraints) {
    using OnExchange = ActiveExtentConstraints::OnExchange;
    for (const OnExchange on_exchange : {OnExchange::release, OnExchange::keep})
      for (int round = 0; round < extent_rounds; ++round) {
        const Points vertices = current_vertices();
        if (state_.levels.size() == 0) state_.levels = extents_.levels(vertices);
        if (remains_at_most(settled_remainder, vertices)) return;
        bool held = false;
        for (std::size_t k = 0; k < extents_.bounds().size(); ++k)
          if (extents_.excess(k, vertices) != 0) held |= extents_.hold(k, vertices, on_exchange);
        if (!held) break;
        solve_held(constraints);
      }
    for (int round = 0; round < extent_rounds; ++round) {
      const Points vertices = current_vertices();
      if (remains_at_most(settled_remainder, vertices)) return;
      extents_.release();
      for (std::size_t k = 0; k < extents_.bounds().size(); ++k)
        if (extents_.excess(k, vertices) != 0 || extents_.is_kept(k))
          extents_.hold(k, vertices, OnExchange::release);
      solve_held(constraints);
    }
  }

  /// Solves for `constraints` and the held vertices together. Returns all these constraints.
  std::vector<Constraint> solve_held(std::vector<Constraint> constraints) {
    for (Constraint& held : extents_.constraints(mesh_.transfer)) constraints.push_back(std::move(held));
    state_ = solve_relations(rig_, corrections_, constraints, std::move(state_));
    return constraints;
  }

  Points current_vertices() const {
    return mesh_.transfer.vertices(rig_, rig_.space.primitives(state_.controls));
  }

  /// Returns whether every residual is small enough for take_up_remainder: that of a kept extent at most
  /// `multiple` times tolerance::relation of the diagonal, that of another bound 0.
  bool remains_at_most(double multiple, const Points& vertices) const {
    for (std::size_t k = 0; k < extents_.bounds().size(); ++k) {
      const double most = extents_.is_kept(k) ? multiple * tolerance::relation * diagonal() : 0;
      if (std::abs(extents_.excess(k, vertices)) > most) return false;
    }
    return true;
  }

  /// Removes the small residual that a solve leaves of a kept extent, by stretching all that moved along it.
  /// Holding vertices cannot remove this residual: which of two vertices at the foot of a leg is the lower
  /// one may change with every solve. Relations between moved parts do not change. Relations to the other
  /// parts are checked afterwards.
  void take_up_remainder() {
    for (int round = 0; round < remainder_rounds; ++round) {
      const Points vertices = current_vertices();
      if (!extents_.any_excess(vertices) || !remains_at_most(largest_remainder, vertices)) return;
      for (std::size_t k = 0; k < extents_.bounds().size(); ++k)
        if (extents_.is_kept(k) && extents_.excess(k, vertices) != 0)
          stretch(extents_.bounds()[k].normal, extents_.range(k, vertices), extents_.wanted(k, vertices));
    }
  }

  /// Applies to all moved classes the affine map along `normal` that maps the heights `from` to `to`.
  void stretch(const Eigen::Vector3d& normal, const Range& from, const Range& to) {
    const double factor = from.length() > 0 ? to.length() / from.length() : 1;
    const auto move = [&](auto& points) {
      const Eigen::VectorXd heights = points * normal;
      points +=
          (to.low + factor * (heights.array() - from.low) - heights.array()).matrix() * normal.transpose();
    };
    for (int c = 0; c < rig_.space.class_count(); ++c) {
      ControlState& state = state_.controls[at(c)];
      if (state.values == start_[at(c)].values) continue;
      const int part = rig_.space.members(c).front();
      Primitive now = rig_.space.primitive(part, state);
      if (auto* cuboid = std::get_if<Cuboid>(&now))
        move(cuboid->corners);
      else
        move(std::get<GeneralizedCylinder>(now).centres);
      state = rig_.space.invariant(c, rig_.space.state_of(part, now));
    }
  }

  /// Returns the constraints that keep the points of the surface nearest to the fixed points at their current
  /// positions.
  std::vector<Constraint> fixed_point_constraints() const {
    std::vector<Constraint> constraints;
    for (const Eigen::Vector3d& point : task_.constraints.fixed_points) {
      const SurfacePoint nearest = mesh_.surface.nearest(point);
      const Eigen::Vector3d weights = barycentric_weights(task_.shape, nearest.triangle, nearest.point);
      Constraint constraint;
      for (int k = 0; k < 3; ++k)
        for (BoundPoint bound : mesh_.transfer.bound_points(task_.shape.triangles(nearest.triangle, k))) {
          bound.weight *= weights(k);
          constraint.target += bound.weight * rig_.primitive_bindings[at(bound.part)].position_of(
                                                  bound.binding, task_.now[at(bound.part)]);
          constraint.bound_points.push_back(std::move(bound));
        }
      constraints.push_back(std::move(constraint));
    }
    return constraints;
  }

  /// Returns the current primitives. Classes that did not move keep their primitives bit for bit.
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
    if (auto refusal = uneven_row()) return refusal;
    for (std::size_t part = 0; part < primitives_.size(); ++part)
      if (auto refusal = defect(rig_.rest.parts[part].primitive, primitives_[part])) {
        refusal->part = static_cast<int>(part);
        return refusal;
      }
    if (const double gap = largest_gap(rig_, fixed_points_, state_) / diagonal();
        !(gap <= tolerance::relation))
      return Refusal{.cause = RefusalCause::fixed_point, .amount = gap};
    return broken_extent();
  }

  std::optional<Refusal> uneven_row() const {
    if (rig_.row_points.empty()) return std::nullopt;
    Eigen::Index worst = 0;
    const double gap = gaps(rig_, row_constraints(rig_), state_).cwiseAbs().maxCoeff(&worst) / diagonal();
    if (gap <= tolerance::relation) return std::nullopt;
    return Refusal{.cause = RefusalCause::uneven_row,
                   .part = rig_.row_points[static_cast<std::size_t>(worst / 3)].parts[1],
                   .amount = gap};
  }

  std::optional<Refusal> broken_relation() const {
    const std::vector<double> residuals = relation_residuals(rig_.rest, primitives_);
    const auto worst = std::max_element(residuals.begin(), residuals.end());
    if (worst == residuals.end() || !(*worst > tolerance::relation)) return std::nullopt;
    return Refusal{.cause = RefusalCause::relation,
                   .relation = static_cast<int>(worst - residuals.begin()),
                   .amount = *worst};
  }

  std::optional<Refusal> broken_extent() const {
    if (extents_.bounds().empty()) return std::nullopt;
    const Points vertices = mesh_.transfer.vertices(rig_, primitives_);
    for (std::size_t k = 0; k < extents_.bounds().size(); ++k) {
      const double excess = extents_.excess(k, vertices);
      if (excess == 0) continue;
      const Eigen::Vector3d& n = extents_.bounds()[k].normal;
      return Refusal{.cause = extents_.bounds()[k].level ? RefusalCause::moved_extent
                              : excess > 0               ? RefusalCause::long_extent
                                                         : RefusalCause::short_extent,
                     .axis = {n.x(), n.y(), n.z()},
                     .amount = std::abs(excess) / diagonal()};
    }
    return std::nullopt;
  }

  const Rig& rig_;
  const RiggedMesh& mesh_;
  const EditTask& task_;
  const PartEdit& edit_;  ///< first edit of the task: that of the handle
  int class_;
  std::vector<Progress> progress_;  ///< per class
  CorrectionSpace corrections_;
  ActiveExtentConstraints extents_;
  std::vector<ControlState> start_;
  SolverState state_;
  std::vector<Constraint> fixed_points_;
  std::vector<Primitive> primitives_;
};

}  // namespace

EditOutcome solve_edit(const Rig& rig, const RiggedMesh& mesh, const EditTask& task) {
  return EditSolution(rig, mesh, task).run();
}

}  // namespace stackabilization::detail
