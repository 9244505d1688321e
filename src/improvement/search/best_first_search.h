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

/// Best-first search, Algorithm 1 of the paper. A step changes the state only after all of its work is done,
/// so an interrupted step leaves no trace. The rest of the search depends only on the state between two
/// steps.
class BestFirstSearch {
 public:
  BestFirstSearch(const RequirementChecker& checker, const BestFirstOptions& options, SearchState state);

  BestFirstResult run();
  std::string state_text() const { return text_of(state_, checker().space().rest().shape.part_names); }

 private:
  /// Result of the checks of a candidate.
  struct Verdict {
    std::optional<NodeState> state;  ///< new state of the candidate; nothing: it has to be expanded
    std::vector<Check> broken;       ///< checks that failed
  };

  const BestFirstOptions& options() const { return tools_.options; }
  const RequirementChecker& checker() const { return tools_.checker; }

  /// Adds the shape at rest once per starting direction.
  void add_roots();
  /// Returns why the search is over, if it is.
  std::optional<SearchEnd> end();
  /// Handles candidate `id`. Returns why the step was not done, if it was not.
  std::optional<SearchEnd> step(int id);
  /// Returns the trials that a search of the cone counts as.
  std::int64_t turning_trials() const;
  Verdict verdict(const Design& design, const Stackability& measured) const;
  void add_successors(int parent, const std::vector<SuccessorNode>& made);
  /// Updates the best S and E with those of a node.
  void notice(const SearchNode& node);
  ImprovementProgress progress() const;
  void save();
  Candidate candidate(int id);
  std::vector<Candidate> nearest();
  std::vector<ObstacleCount> refusals() const;
  BestFirstResult result(SearchEnd end);

  SearchTools tools_;
  SearchState state_;
  Interruption interruption_;
  DesignStore designs_;
  ConeSearch cone_;
  SolutionDiversity distinct_;
  std::vector<std::pair<int, std::shared_ptr<const Design>>> solutions_;
  double best_stackability_ = -std::numeric_limits<double>::infinity();
  double best_energy_ = std::numeric_limits<double>::infinity();
  std::chrono::steady_clock::time_point last_save_ = std::chrono::steady_clock::now();
  double save_seconds_ = 0;  ///< duration of the last save
};

}  // namespace stackabilization::detail
