#pragma once

#include <Eigen/Core>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "apps/improve/improve_options.h"
#include "stackabilization/improvement/front.h"
#include "stackabilization/improvement/task.h"

namespace stackabilization::apps {

/// A task for `improve`, and the model and options that it was made of.
struct ImproveTask {
  Model model;  ///< as read, parts that were taken out included
  std::unique_ptr<const ImprovementTask> task;
  std::optional<SavedSearch> saved;  ///< what --resume goes on with

  const StructuredShape& rest() const { return task->rest(); }
  const RequirementChecker& checker() const { return task->checker(); }
  double target() const { return checker().requirements().target; }
  /// --within, model units.
  std::optional<double> length_limit() const {
    const std::optional<StackLengthLimit>& limit = checker().requirements().length_limit;
    return limit ? std::optional(limit->length) : std::nullopt;
  }
};

/// Reads and analyses the model, takes out parts and makes the task. `watch`: what --time counts. Throws as
/// these do.
ImproveTask improve_task(const CLI::App& command, const ImproveCommandOptions& options,
                         const Stopwatch& watch);

/// What the search found, and how it ended.
struct ImproveRun {
  ImprovementOptions options;
  Improvement result;
  std::optional<Front> front;  ///< with --front; its designs but the first are the solutions
  bool running = false;        ///< the search goes on: what is here are designs found so far
  bool interrupted = false;    ///< by a signal, which is answered once all is written
};

/// Has it ended, and was it not stopped, by a signal or a limit? Then there is nothing to go on with.
bool ended_by_itself(const ImproveRun& run);

/// Searches with a line of progress on standard error. The state goes to the folder before the search, and
/// now and then; a caller has no folder. `found`: told of every design that is found, when it is, with the
/// run so far, which is running. Throws InputError when --resume finds the state of another search.
ImproveRun run_improve(const ImproveCommandOptions& options, const ImproveTask& task, const Stopwatch& watch,
                       const std::function<void(const ImproveRun&, const Candidate&)>& found = {});

}  // namespace stackabilization::apps
