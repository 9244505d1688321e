#include "stackabilization/improvement/task.h"

#include <Eigen/Geometry>
#include <cmath>
#include <utility>

#include "core/angles.h"
#include "stackabilization/deformation/factory.h"
#include "stackabilization/improvement/effort.h"
#include "stackabilization/improvement/tolerances.h"
#include "stackabilization/stacking/search.h"
#include "stackabilization/stacking/tolerances.h"

namespace stackabilization {

namespace {

/// Share of the effort for the search for directions.
constexpr double directions_share = 0.15;
/// Another direction than up is worth the work of a search if it raises S by more than this.
constexpr double clearly_better = 0.1;
/// A direction that is free may turn by this angle at each edit, degrees.
constexpr double free_cone_degrees = 10;
/// Cosine of one degree. An axis of the shape may differ by this angle from the z axis and still be up: a hat
/// that stands slightly aslant stacks along its own axis.
constexpr double nearly_up = 0.99985;

/// Returns an axis of symmetry, or the line that two mirror planes share, near the z axis.
std::optional<Eigen::Vector3d> upright_axis(const Structure& structure) {
  std::vector<Eigen::Vector3d> axes;
  const std::vector<Symmetry>& symmetries = structure.symmetries;
  for (std::size_t i = 0; i < symmetries.size(); ++i) {
    if (symmetries[i].kind != SymmetryKind::reflection) axes.push_back(symmetries[i].axis);
    for (std::size_t j = 0; j < i; ++j)
      if (symmetries[i].kind == SymmetryKind::reflection && symmetries[j].kind == SymmetryKind::reflection)
        axes.push_back(symmetries[i].axis.cross(symmetries[j].axis));
  }
  for (const Eigen::Vector3d& axis : axes)
    if (std::abs(axis.z()) > nearly_up * axis.norm()) return axis.z() < 0 ? Eigen::Vector3d(-axis) : axis;
  return std::nullopt;
}

/// Measures S along the z axis, or along the upright axis of the shape where S is larger. An axis that is
/// off by a hair jams what fits straight down.
Stackability measure_up(const StackabilitySolver& solver, const Structure& structure) {
  const Stackability of_file = solver.measure(Direction(0, 0, 1));
  const std::optional<Eigen::Vector3d> axis = upright_axis(structure);
  if (!axis) return of_file;
  const Stackability of_shape = solver.measure(Direction(*axis));
  return of_shape.value > of_file.value + tolerance::stackability ? of_shape : of_file;
}

}  // namespace

ImprovementTask::ImprovementTask(StructuredShape rest, Requirements requirements,
                                 const ImprovementTaskOptions& options)
    : directions_(options.directions.empty() ? options.chosen : options.directions),
      free_(options.directions.empty() && !requirements.length_limit &&
            !capabilities_of(options.kind).edits_along_one_direction) {
  validate(requirements, rest);
  auto known = std::make_shared<const RestShape>(rest, requirements.measure);
  if (directions_.empty()) {
    const StackabilitySolver& solver = known->solver_without_play();
    const Stackability up = measure_up(solver, rest.structure);
    directions_ = {up.direction};
    if (free_) {
      SearchOptions search;
      if (requirements.quality) search.cone = DirectionCone{up.direction, tolerance::max_stack_lean};
      search.max_directions = directions_of_effort(directions_share * options.effort, rest.shape);
      search.progress = options.progress;
      search.cancelled = options.cancelled;
      const SearchResult found = best_direction(solver, search);
      cancelled_ = found.cancelled;
      if (!cancelled_ && found.best.value > up.value + clearly_better &&
          !detail::on_one_line(found.best.direction, up.direction, tolerance::direction_step))
        directions_.push_back(found.best.direction);
    }
  }
  const Direction first(directions_.front());
  if (requirements.length_limit)
    requirements.target = target_within(*requirements.length_limit, *known, first);
  const Following following =
      options.following.value_or(requirements.quality ? Following::smooth : Following::free);
  space_ = deformation_model(std::move(rest), {options.kind, first, {}, following});
  checker_ = std::make_unique<RequirementChecker>(*space_, std::move(requirements), std::move(known));
}

ImprovementOptions improvement_options(const ImprovementTask& task) {
  ImprovementOptions options = improvement_options(task.space());
  if (task.directions_are_free()) options.search.cone_degrees = free_cone_degrees;
  return options;
}

Improvement improve(const ImprovementTask& task) {
  return improve(task, improvement_options(task));
}

Improvement improve(const ImprovementTask& task, ImprovementOptions options,
                    const std::optional<SavedSearch>& state) {
  options.search.directions = task.directions();
  return improve(task.checker(), options, state);
}

}  // namespace stackabilization
