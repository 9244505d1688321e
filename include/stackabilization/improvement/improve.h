#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "stackabilization/improvement/best_first.h"
#include "stackabilization/improvement/diagnosis.h"
#include "stackabilization/improvement/refinement.h"

namespace stackabilization {

/// How much of `improve` goes beyond the paper.
enum class ImprovementPreset {
  paper,    ///< search only, with the paper's edits and steps
  refined,  ///< a pursuit, that, and a search with further edits, then continuous magnitudes of what they
            ///< find
};

/// Options of `improve`.
struct ImprovementOptions {
  ImprovementPreset preset = ImprovementPreset::refined;  ///< which steps are taken
  /// How much work is done at most, > 0, see effort.h: 1 comes to about 40 seconds on two cores. The result
  /// depends on it, and not on the machine.
  double effort = 1;
  /// Its alpha, edits, directions, deadline, callbacks and expansions, of which there is one at least, hold
  /// for the whole run; its trials follow from the effort.
  BestFirstOptions search;
  RefinementOptions refinement;  ///< of the continuous magnitudes
};

/// What `improve` came to: solutions, or why there are none.
struct Improvement {
  Candidate before;  ///< the shape at rest, along the direction of the best solution
  /// Best first: of the paper's preset those of least E. Refined ones all meet the target, so that more S is
  /// no merit: those of least change (RefinementOptions::least).
  std::vector<Candidate> solutions;
  std::vector<Assessment> assessments;  ///< of the solutions
  std::optional<Candidate> nearest;     ///< the best S reached, when there is no solution
  std::optional<Diagnosis> diagnosis;   ///< why there is none
  /// `expanded` counts both searches, `evaluated` all designs that were measured, those of pursuits and
  /// refinements too; the rest is of the last search.
  ImprovementProgress progress;
  /// Why it ended: `time_limit` whenever the deadline ended any part of it, `solved` when there are as many
  /// solutions as wanted, else why the last search ended.
  SearchEnd end = SearchEnd::exhausted;
};

/// From a wish to designs that stack: a pursuit along every starting direction, the paper's search,
/// best-first search with further edits, refinement of what they find (and, where there are too few
/// solutions, of what came nearest), checks, and a reason when it cannot be done. Where the work suffices for
/// the paper's search, the change of the refined preset is at most that of the paper's for the same target.
/// See pursuit.h, best_first.h and refinement.h for guarantees. The same result for any number of threads and
/// on every machine, unless a deadline ends it.
///
/// `state`: what an interrupted run of the same task saved last. The result is that of a run that was not
/// interrupted: phases before and after the last search are done again, which has the same outcome.
Improvement improve(const RequirementChecker& checker, const ImprovementOptions& options,
                    const std::optional<SavedSearch>& state = std::nullopt);

}  // namespace stackabilization
