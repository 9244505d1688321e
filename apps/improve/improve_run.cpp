#include "apps/improve/improve_run.h"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <iostream>
#include <optional>
#include <utility>

#include "apps/common/interrupt.h"
#include "apps/common/progress.h"
#include "apps/common/text.h"
#include "apps/improve/improve_files.h"
#include "stackabilization/improvement/effort.h"
#include "stackabilization/improvement/removal.h"
#include "stackabilization/io/read_file.h"
#include "stackabilization/io/write_file.h"
#include "stackabilization/stacking/plan.h"
#include "stackabilization/stacking/search.h"

namespace stackabilization::apps {

namespace {

/// Share of --time that the search for directions may take.
constexpr double directions_end = 0.25;
/// What is left for the search in any case: enough to say where the design stands.
constexpr double min_seconds = 1e-3;

/// Options of the task: the directions given, or of the search to go on with, else those that it chooses.
ImprovementTaskOptions task_options(const ImproveCommandOptions& options,
                                    const std::optional<SavedSearch>& saved, const Stopwatch& watch) {
  ImprovementTaskOptions result;
  result.kind = options.kind;
  if (options.bends || options.preset == ImprovementPreset::paper) result.following = Following::free;
  result.directions = options.directions;
  if (saved) result.chosen = directions_of(*saved);
  result.effort = effort_of(options);
  if (options.seconds)
    result.cancelled = [&watch, end = directions_end * *options.seconds] { return watch.seconds() > end; };
  return result;
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
  if (progress.work > 0) text += "  " + std::to_string(std::lround(100 * progress.work)) + " % of the work";
  if (std::isfinite(progress.seconds_left))
    text += "  " + std::to_string(std::lround(std::ceil(progress.seconds_left))) + " s left";
  return text;
}

/// Runs `improve` for every target of a front. Its designs are solutions, from least to most change.
void run_front(const ImproveCommandOptions& options, const ImproveTask& task, ImproveRun& run) {
  FrontOptions front;
  front.points = options.wanted() + 1;
  front.improvement = run.options;
  run.front = improvement_front(*task.task, front);
  const auto& points = run.front->points;
  run.result.before = points.front().candidate;
  for (std::size_t k = 1; k < points.size(); ++k) {
    run.result.solutions.push_back(points[k].candidate);
    run.result.assessments.push_back(points[k].assessment);
  }
  if (points.size() == 1) run.result.nearest = run.front->nearest;
  run.result.diagnosis = run.front->diagnosis;
  run.result.progress = {};
  run.result.progress.evaluated = run.front->evaluated;
  run.result.end = run.front->end;
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
    Requirements requirements = requirements_of(
        options.requirements, rest.shape, options.measure,
        options.preset == ImprovementPreset::paper ? QualityDefault::any : QualityDefault::limited);
    requirements.target = options.wanted_target().value_or(0);
    requirements.length_limit = options.room.limit(rest.shape.unit);
    ProgressBar bar("Looking for directions", options.common.caller);
    ImprovementTaskOptions how = task_options(options, task.saved, watch);
    how.progress = [&bar](double fraction) { bar.show(fraction); };
    if (const Caller* const caller = options.common.caller; caller && caller->stopped)
      how.cancelled = [caller, late = how.cancelled] { return caller->stopped() || (late && late()); };
    task.task = std::make_unique<const ImprovementTask>(std::move(rest), std::move(requirements), how);
  });
  return task;
}

bool ended_by_itself(const ImproveRun& run) {
  return !run.running && !run.interrupted &&
         (run.result.end == SearchEnd::solved || run.result.end == SearchEnd::exhausted);
}

ImproveRun run_improve(const ImproveCommandOptions& options, const ImproveTask& task, const Stopwatch& watch,
                       const std::function<void(const ImproveRun&, const Candidate&)>& found) {
  const Caller* const caller = options.common.caller;
  ImproveRun run;
  run.running = true;
  run.options = improvement_options_of(options, *task.task);
  const std::filesystem::path state = state_file(options.folder);
  std::error_code error;
  if (!task.saved && !caller) std::filesystem::remove(state, error);
  const DeferredInterrupts interrupts(caller);
  StatusLine status;
  BestFirstOptions& search = run.options.search;
  if (options.seconds) search.seconds = std::max(*options.seconds - watch.seconds(), min_seconds);
  search.progress = [&status, &run, caller](const ImprovementProgress& progress) {
    run.result.progress = progress;
    if (caller && caller->progress)
      caller->progress("Improving", progress.work);
    else if (status.due())
      status.show(status_text(progress));
  };
  search.cancelled = [&interrupts] { return interrupts.requested(); };
  if (found) run.options.found = [&found, &run](const Candidate& candidate) { found(run, candidate); };
  if (!options.front && !caller)
    search.save = [&state](const std::string& text) { write_file_atomically(state, text); };
  try {
    if (options.front)
      run_front(options, task, run);
    else
      run.result = improve(*task.task, run.options, task.saved);
  } catch (const SavedSearchError&) {
    throw;
  } catch (const InputError& error_of_model) {
    throw InputError(display_name(task.model) + ": " + error_of_model.what());
  }
  run.running = false;
  run.interrupted = interrupts.requested();
  if (task.task->cancelled() && !run.interrupted) run.result.end = SearchEnd::time_limit;
  return run;
}

}  // namespace stackabilization::apps
