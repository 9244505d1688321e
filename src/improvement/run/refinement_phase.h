#pragma once

#include <cstddef>
#include <functional>
#include <optional>
#include <vector>

#include "improvement/design/distinct.h"
#include "improvement/run/work_budget.h"
#include "stackabilization/improvement/improve.h"

namespace stackabilization::detail {

/// Least number of solutions that are searched: the best one is not known before refinement.
constexpr int min_refined = 3;

/// Returns whether S of `a` is larger than that of `b`.
bool more_stackable(const Candidate& a, const Candidate& b);

/// Refines the results of a search: first all of them with the given edits, then the best ones with added
/// edits, until there are as many different solutions as wanted.
class RefinementPhase {
 public:
  /// `report`: called after each refinement. The checker and the budget must outlive this object.
  RefinementPhase(const RequirementChecker& checker, const ImprovementOptions& options, WorkBudget& budget,
                  std::function<void()> report);
  RefinementPhase(const RefinementPhase&) = delete;
  RefinementPhase& operator=(const RefinementPhase&) = delete;

  /// Refines `starts` (results of other phases) and the results of the search, and returns the solutions, of
  /// least change first. Begins with candidates that reach the target, least change first, since the work may
  /// run out. To be called once.
  std::vector<Candidate> refined(std::vector<Candidate> starts, const BestFirstResult& found);

  /// Returns the most stackable refined candidate that does not reach the target, if any.
  const std::optional<Candidate>& nearest() const { return nearest_; }

 private:
  bool at_end() const;
  RefinementResult refinement(const Candidate& start, RefinementOptions options);
  RefinementResult as_it_is(const Candidate& start) const;
  void add(const Candidate& start);
  void rescue(const std::vector<Candidate>& starts);
  void extend();
  void keep(Candidate candidate);
  void note_nearest(Candidate candidate);

  const RequirementChecker& checker_;
  RefinementOptions options_;
  std::size_t wanted_;
  WorkBudget& budget_;
  std::function<void()> report_;
  std::function<void(const Candidate&)> found_;
  double share_;  ///< share of the work at which the current step ends
  std::function<bool(const Candidate&, const Candidate&)> less_changed_;
  SolutionDiversity distinct_;
  std::vector<Candidate> solutions_;
  std::optional<Candidate> nearest_;
};

}  // namespace stackabilization::detail
