#include "apps/improve_run.h"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <iostream>
#include <optional>
#include <utility>

#include "apps/improve_files.h"
#include "apps/interrupt.h"
#include "apps/progress.h"
#include "apps/text.h"
#include "stackabilization/core/tolerances.h"
#include "stackabilization/improvement/effort.h"
#include "stackabilization/improvement/removal.h"
#include "stackabilization/io/read_file.h"
#include "stackabilization/io/write_file.h"
#include "stackabilization/stacking/plan.h"
#include "stackabilization/stacking/search.h"

namespace stackabilization::apps {

namespace {

bool parallel(const Eigen::Vector3d& a, const Eigen::Vector3d& b) {
  return a.cross(b).norm() <= tolerance::direction_step * a.norm() * b.norm();
}

/// Another direction than up is worth its time when it is better by this much.
constexpr double clearly_better = 0.1;
/// Cosine of the largest angle, one degree, by which an axis of the shape may miss the upward axis of the
/// file and still be what "up" may mean: a hat that stands a hair aslant stacks along its own axis.
constexpr double nearly_up = 0.99985;

/// An axis of symmetry, or the line that two mirror planes share, that may be what "up" means.
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

/// Up: the upward axis of the file, or that of the shape where it stacks better along it. Axes are found on
/// the shape, more or less closely: one that is off by a hair jams what fits straight down.
Stackability upward(const StackabilitySolver& solver, const Structure& structure) {
  const Stackability of_file = solver.measure(Direction(0, 0, 1));
  const std::optional<Eigen::Vector3d> axis = upright_axis(structure);
  if (!axis) return of_file;
  const Stackability of_shape = solver.measure(Direction(*axis));
  return of_shape.value > of_file.value + tolerance::stackability ? of_shape : of_file;
}

/// Shares of the effort and of --time that the look for directions may take.
constexpr double directions_effort = 0.15;
constexpr double directions_end = 0.25;
/// What is left for the search in any case: enough to say where the design stands.
constexpr double min_seconds = 1e-3;

/// The best direction that a fixed amount of work finds; nothing where --time ends it before.
std::optional<Stackability> best_found(const ImproveCommandOptions& options, const StackabilitySolver& solver,
                                       const Stopwatch& watch) {
  ProgressBar bar("Looking for directions");
  SearchOptions search;
  const double effort = directions_effort * improvement_options_of(options).effort;
  search.max_directions = directions_of_effort(effort, solver.shape());
  search.progress = [&bar](double fraction) { bar.show(fraction); };
  if (options.seconds)
    search.cancelled = [&watch, end = directions_end * *options.seconds] { return watch.seconds() > end; };
  const SearchResult found = best_direction(solver, search);
  return found.cancelled ? std::nullopt : std::optional(found.best);
}

/// Those given, or of the search to go on with, else up and, where another one is clearly better, the best
/// one found.
std::vector<Eigen::Vector3d> starting_directions(const ImproveCommandOptions& options,
                                                 const StructuredShape& rest, const Stopwatch& watch,
                                                 ImproveTask& task) {
  if (!options.directions.empty()) return options.directions;
  if (task.saved) return directions_of(*task.saved);
  const StackabilitySolver solver(rest.shape, options.measure);
  const Stackability up = upward(solver, rest.structure);
  std::vector<Eigen::Vector3d> directions = {up.direction};
  if (options.copies || options.kind == DeformationKind::gap_scaling) return directions;
  const std::optional<Stackability> best = best_found(options, solver, watch);
  task.late = !best;
  if (best && best->value > up.value + clearly_better && !parallel(best->direction, up.direction))
    directions.push_back(best->direction);
  return directions;
}

/// The target that a wish for copies comes to, with the height and the boxes at rest.
double target_of(const ImproveCommandOptions& options, const Requirements& asked, const Stackability& rest) {
  const StackPlan plan =
      plan_stack(rest, {asked.length_limit->copies, asked.length_limit->length, asked.clearance});
  if (!plan.possible || *plan.stackability >= 1)
    throw UsageError(
        "--within " + options.within->text + " has no room for " + std::to_string(*options.copies) +
        " copies of height " + exact_digits(rest.extent) +
        (asked.clearance > 0 ? " with " + exact_digits(asked.clearance) + " of air between them" : "") +
        ", however well they stack");
  return *plan.stackability;
}

/// What --resume finds in the folder.
std::optional<SavedSearch> saved_search(const ImproveCommandOptions& options) {
  const std::filesystem::path file = state_file(options.folder);
  std::error_code error;
  if (!options.resume) return std::nullopt;
  if (std::filesystem::exists(file, error)) return SavedSearch{read_file(file), file.string()};
  if (!options.common.quiet)
    std::cerr << "stackabilize: there is no " + file.string() + " to go on with, so the search starts anew\n";
  return std::nullopt;
}

std::string status_text(const ImprovementProgress& progress) {
  std::string text = "best S " + rounded(progress.best_stackability) + "  best E " +
                     rounded(progress.best_energy) + "  expanded " + std::to_string(progress.expanded) +
                     "  queued " + std::to_string(progress.queued) + "  solutions " +
                     std::to_string(progress.solutions);
  if (std::isfinite(progress.seconds_left))
    text += "  " + std::to_string(std::lround(std::ceil(progress.seconds_left))) + " s left";
  return text;
}

}  // namespace

ImproveTask improve_task(const CLI::App& command, const ImproveCommandOptions& options,
                         const Stopwatch& watch) {
  StructuredModel input = load_structured(command, options.common, options.analysis, bounds_of_designs);
  ImproveTask task;
  task.model = std::move(input.model);
  task.saved = saved_search(options);
  named(task.model, [&] {
    StructuredShape rest = std::move(input.structured);
    if (!options.removed.empty())
      rest = without_parts(rest, parts_named("--remove", options.removed, rest.shape));
    Requirements requirements = requirements_of(options.requirements, rest.shape);
    requirements.measure = options.measure;
    requirements.target = options.target.value_or(0);
    if (options.within) task.room = options.within->in(rest.shape.unit);
    task.directions = starting_directions(options, rest, watch, task);
    const Direction first(task.directions.front());
    if (task.room) {
      requirements.length_limit = StackLengthLimit{*options.copies, *task.room};
      requirements.target =
          target_of(options, requirements, stackability(rest.shape, first, options.measure));
    }
    task.space = design_space(std::move(rest), {options.kind, first});
    task.checker = std::make_unique<RequirementChecker>(*task.space, requirements);
  });
  return task;
}

bool ended_by_itself(const ImproveRun& run) {
  return !run.interrupted && (run.result.end == SearchEnd::solved || run.result.end == SearchEnd::exhausted);
}

ImproveRun run_improve(const ImproveCommandOptions& options, const ImproveTask& task,
                       const Stopwatch& watch) {
  ImproveRun run;
  run.options = improvement_options_of(options);
  const std::filesystem::path state = state_file(options.folder);
  std::error_code error;
  if (!task.saved) std::filesystem::remove(state, error);
  const DeferredInterrupts interrupts;
  StatusLine status;
  BestFirstOptions& search = run.options.search;
  if (options.seconds) search.seconds = std::max(*options.seconds - watch.seconds(), min_seconds);
  search.directions = task.directions;
  search.progress = [&status](const ImprovementProgress& progress) {
    if (status.due()) status.show(status_text(progress));
  };
  search.cancelled = [&interrupts] { return interrupts.requested(); };
  search.save = [&state](const std::string& text) { write_file_atomically(state, text); };
  try {
    run.result = improve(*task.checker, run.options, task.saved);
  } catch (const SavedSearchError&) {
    throw;
  } catch (const InputError& error_of_model) {
    throw InputError(display_name(task.model) + ": " + error_of_model.what());
  }
  run.interrupted = interrupts.requested();
  if (task.late && !run.interrupted) run.result.end = SearchEnd::time_limit;
  return run;
}

}  // namespace stackabilization::apps
