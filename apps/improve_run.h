#pragma once

#include <Eigen/Core>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "apps/improve_options.h"
#include "stackabilization/improvement/improve.h"

namespace stackabilization::apps {

/// A task for `improve`: a design space and what is asked of its designs.
struct ImproveTask {
  Model model;  ///< as read, parts that were taken out included
  std::unique_ptr<const DesignSpace> space;
  std::unique_ptr<const RequirementChecker> checker;
  std::vector<Eigen::Vector3d> directions;
  std::optional<double> room;        ///< --within, model units
  std::optional<SavedSearch> saved;  ///< what --resume goes on with
  bool late = false;                 ///< --time ended the look for directions

  const StructuredShape& rest() const { return space->rest(); }
  double target() const { return checker->requirements().target; }
};

/// Reads and analyses the model, takes out parts, looks for directions, unless they are given or those of the
/// search to go on with, and turns the wish into a target: the stackability_within that the copies take, for
/// the height and the boxes at rest. What becomes of the height of the stack is checked on the solutions.
///
/// `watch`: what --time counts. Throws as these do, and UsageError when not even the bare heights fit.
ImproveTask improve_task(const CLI::App& command, const ImproveCommandOptions& options,
                         const Stopwatch& watch);

/// What the search found, and how it ended.
struct ImproveRun {
  ImprovementOptions options;
  Improvement result;
  bool interrupted = false;  ///< by a signal, which is answered once all is written
};

/// Was it not stopped, by a signal or a limit? Then there is nothing to go on with.
bool ended_by_itself(const ImproveRun& run);

/// Searches with a line of progress on standard error. The state goes to the folder before the search, and
/// now and then. Throws InputError when --resume finds the state of another search.
ImproveRun run_improve(const ImproveCommandOptions& options, const ImproveTask& task, const Stopwatch& watch);

}  // namespace stackabilization::apps
