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
  BestFirstOptions search;  ///< its alpha, edits, directions, seconds and callbacks hold for the whole run
  RefinementOptions refinement;  ///< of the continuous magnitudes
};

/// What `improve` came to: solutions, or why there are none.
struct Improvement {
  Candidate before;  ///< the shape at rest, along the direction of the best solution
  /// Best first: of the paper's preset those of least E. Refined ones all meet the target, so that more S is
  /// no merit: those of least change (RefinementOptions::least).
  std::vector<Candidate> solutions;
  std::vector<Assessment> assessments;   ///< of the solutions
  std::optional<Candidate> nearest;      ///< the best S reached, when there is no solution
  std::optional<Diagnosis> diagnosis;    ///< why there is none
  ImprovementProgress progress;          ///< of the search
  SearchEnd end = SearchEnd::exhausted;  ///< why the search ended
};

/// From a wish to designs that stack: a pursuit along every starting direction, the paper's search,
/// best-first search with further edits, refinement of what they find (and, where there are too few
/// solutions, of what came nearest), checks, and a reason when it cannot be done. Where no limit of time ends
/// the paper's search, the change of the refined preset is at most that of the paper's for the same target.
/// See pursuit.h, best_first.h and refinement.h for guarantees. `state`: what an interrupted run of the same
/// task saved, of the last search.
Improvement improve(const RequirementChecker& checker, const ImprovementOptions& options,
                    const std::optional<std::string>& state = std::nullopt);

}  // namespace stackabilization
