#pragma once

#include <optional>
#include <string>
#include <vector>

#include "apps/common/holding.h"
#include "apps/improve/improve_run.h"
#include "apps/report/design_words.h"
#include "stackabilization/improvement/confirmation.h"
#include "stackabilization/improvement/explanation.h"
#include "stackabilization/improvement/shape_change.h"
#include "stackabilization/stacking/stack_search.h"

namespace stackabilization::apps {

/// Everything there is to say about one solution, or about what came nearest.
struct SolutionReport {
  std::string name;   ///< "solution_1", "nearest"
  double target = 0;  ///< S that was asked for
  Candidate candidate;
  Assessment assessment;
  Stackability before;  ///< of the shape at rest, along the direction of the candidate
  ShapeChange change;
  Explanation explanation;
  std::vector<double> residuals;  ///< per relation, fraction of the diagonal
  StackHeights stack;
  std::optional<TwistResult> twist;  ///< with --twist
  /// How a stack of the shown copies holds; nothing where copies pass each other.
  std::optional<Holding> holding;
  std::vector<Confirmation> written;  ///< what the mesh says as written

  Direction direction() const { return Direction(candidate.direction); }
  /// Does the written mesh say what the report says?
  bool confirmed() const;
  /// Is the target reached, every requirement met and the mesh confirmed?
  bool good() const;
};

/// Measures a candidate, which was held against the requirements before, in all respects but `written`.
SolutionReport solution_report(const ImproveCommandOptions& options, const ImproveTask& task,
                               const Candidate& candidate, const Assessment& assessment);

}  // namespace stackabilization::apps
