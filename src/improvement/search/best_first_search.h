#pragma once

#include <chrono>
#include <limits>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "improvement/design/distinct.h"
#include "improvement/search/cone_search.h"
#include "improvement/search/design_store.h"
#include "improvement/search/expansion.h"
#include "improvement/search/search_state.h"

namespace stackabilization::detail {

/// Algorithm 1. A step changes the state when all of it is done, so that one that is interrupted leaves no
/// trace, and the state between two steps is all that the rest of the search depends on.
class BestFirstSearch {
 public:
  BestFirstSearch(const RequirementChecker& checker, const BestFirstOptions& options, SearchState state);

  BestFirstResult run();
  std::string state_text() const { return text_of(state_); }

 private:
  /// What is known of a candidate once it is looked at.
  struct Verdict {
    std::optional<NodeState> state;  ///< nothing when successors are to be made
    std::vector<std::string> broken;
  };

  const BestFirstOptions& options() const { return tools_.options; }
  const RequirementChecker& checker() const { return tools_.checker; }

  void add_roots();
  std::optional<SearchEnd> end();
  /// Why the step is not done, if it is not.
  std::optional<SearchEnd> step(int id);
  /// What the search for another direction counts as.
  std::int64_t turning_trials() const;
  Verdict verdict(const Design& design, const Stackability& measured) const;
  void add_successors(int parent, const std::vector<Successor>& made);
  void notice(const SearchNode& node);
  ImprovementProgress progress() const;
  void save();
  Candidate candidate(int id);
  std::vector<Candidate> nearest();
  std::vector<RefusalCount> refusals() const;
  BestFirstResult result(SearchEnd end);

  SearchTools tools_;
  SearchState state_;
  Interruption interruption_;
  DesignStore designs_;
  ConeSearch cone_;
  Distinctness distinct_;
  std::vector<std::pair<int, std::shared_ptr<const Design>>> solutions_;
  double best_stackability_ = -std::numeric_limits<double>::infinity();
  double best_energy_ = std::numeric_limits<double>::infinity();
  std::chrono::steady_clock::time_point last_save_ = std::chrono::steady_clock::now();
  double save_seconds_ = 0;  ///< that the last save took
};

}  // namespace stackabilization::detail
