#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "stackabilization/improvement/best_first.h"
#include "stackabilization/improvement/diagnosis.h"
#include "stackabilization/improvement/refinement.h"

namespace stackabilization {

/// Phases that `improve` runs.
enum class ImprovementPreset {
  paper,  ///< best-first search with the edits and steps of the paper
  /// Beyond the paper: a pursuit, the paper's search, a search with the extended edits, then refinement
  /// (continuous magnitudes) of the designs found.
  refined,
};

/// Options of `improve`.
struct ImprovementOptions {
  ImprovementPreset preset = ImprovementPreset::refined;  ///< phases to run
  /// Limit of the work, > 0, see effort.h; 1 takes about 40 seconds on two cores. The result depends on the
  /// effort, not on the machine.
  double effort = 1;
  /// Options of the searches. alpha, edits, directions, deadline, callbacks and expansions (at least 1) apply
  /// to the whole run. The number of trials follows from `effort`. `cancelled` may be asked from any thread.
  BestFirstOptions search;
  RefinementOptions refinement;  ///< options of the refinement
  /// Designs that refinement starts from too, such as those for a similar target. A solution never changes
  /// the shape by more than such a design that meets the requirements. Not used by the paper's preset, and no
  /// part of a saved state.
  std::vector<Candidate> starts = {};
  /// Called from the calling thread with designs that meet the requirements: those of pursuits and of
  /// refinements as soon as each is found, the solutions of a search when it ends.
  std::function<void(const Candidate&)> found = {};
};

/// Returns the options that suit a deformation model: with Following::smooth smooth edits
/// (EditFamily::smooth) and a price of each edit, otherwise the defaults.
ImprovementOptions improvement_options(const DeformationModel& space);

/// Result of `improve`: solutions, or the reason why there are none.
struct Improvement {
  Candidate before;  ///< the shape at rest, along the direction of the best solution
  /// Solutions, best first. Preset `paper`: least E first. Preset `refined`: least change first
  /// (RefinementOptions::objective), since all refined solutions meet the target and a larger S is no merit.
  std::vector<Candidate> solutions;
  std::vector<Assessment> assessments;  ///< one assessment per solution
  std::optional<Candidate> nearest;     ///< candidate of largest S, when there is no solution
  std::optional<Diagnosis> diagnosis;   ///< why there is no solution
  /// `expanded` counts both searches. `evaluated` counts all designs measured, also by pursuits and
  /// refinements. The best S and E are those of pursuits and searches, the other fields those of the last
  /// search.
  ImprovementProgress progress;
  /// `cancelled` when the caller cancelled the run. Otherwise `time_limit` when the deadline ended any phase.
  /// Otherwise `solved` when there are as many solutions as wanted, or when only refinement reached the
  /// target after the search had run out of candidates. Otherwise the end of the last search.
  SearchEnd end = SearchEnd::exhausted;
};

/// Searches for designs that meet the requirements. Preset `refined`: a pursuit along every starting
/// direction, the paper's search, a search with the extended edits, then refinement of the designs found
/// (with too few solutions, also of the candidates of largest S). Solutions are checked; without a solution
/// the result has a diagnosis. Guarantees: see gap_descent.h, best_first.h and refinement.h. If the effort
/// suffices for the paper's search, the refined preset changes the shape by at most as much as the paper's
/// preset for the same target. With limits of quality there is no search in the paper's steps, and no such
/// guarantee; without a start that reaches the target, refinement adds edits that increase S. The result is
/// the same for any number of threads and on every machine, unless a deadline ends the run.
///
/// `state`: the last text that an interrupted run of the same task saved. The result then equals that of an
/// uninterrupted run: the phases before and after the last search are run again, with the same outcome.
/// Throws UsageError for options out of range, SavedSearchError for a state that cannot be resumed.
Improvement improve(const RequirementChecker& checker, const ImprovementOptions& options,
                    const std::optional<SavedSearch>& state = std::nullopt);

}  // namespace stackabilization
