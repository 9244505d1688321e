#include "stackabilization/improvement/best_first.h"

#include "improvement/search/best_first_search.h"
#include "stackabilization/core/errors.h"

namespace stackabilization {

namespace {

void validate(const RequirementChecker& checker, const BestFirstOptions& options) {
  if (options.solutions < 1) throw UsageError("a search looks for one solution at least");
  if (options.expansions < 0)
    throw UsageError("the number of candidates that a search expands must not be negative");
  if (options.trials < 0) throw UsageError("the number of edits that a search tries must not be negative");
  if (!(options.seconds > 0)) throw UsageError("the deadline of a search must be positive");
  if (!(options.cone_degrees >= 0) || options.cone_degrees > 90)
    throw UsageError("the cone in which a direction is searched again must be within 0 and 90 degrees");
  if (options.cone_degrees > 0 && checker.space().capabilities().edits_along_one_direction)
    throw UsageError("gap scaling keeps the direction that it scales along: its cone is one of 0 degrees");
  if (options.directions.empty()) throw UsageError("a search needs a direction to start from");
  for (const Eigen::Vector3d& direction : options.directions) static_cast<void>(Direction(direction));
}

detail::SearchState at_start(const RequirementChecker& checker, const BestFirstOptions& options) {
  return {detail::task_fingerprint(checker, options), options.directions};
}

}  // namespace

BestFirstResult best_first(const RequirementChecker& checker, const BestFirstOptions& options) {
  validate(checker, options);
  return detail::BestFirstSearch(checker, options, at_start(checker, options)).run();
}

BestFirstResult resume_best_first(const RequirementChecker& checker, const BestFirstOptions& options,
                                  const SavedSearch& state) {
  validate(checker, options);
  return detail::BestFirstSearch(checker, options,
                                 detail::read_state(state, detail::search_task(checker, options)))
      .run();
}

std::string search_at_start(const RequirementChecker& checker, const BestFirstOptions& options) {
  validate(checker, options);
  return detail::BestFirstSearch(checker, options, at_start(checker, options)).state_text();
}

}  // namespace stackabilization
