#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include "improvement/search/search_tree.h"
#include "stackabilization/improvement/best_first.h"

namespace stackabilization::detail {

/// Everything that a search knows between two steps, apart from what follows from it.
struct SearchState {
  SearchState(std::uint64_t the_task, std::vector<Eigen::Vector3d> the_directions)
      : task(the_task),
        tree(static_cast<int>(the_directions.size())),
        directions(std::move(the_directions)) {}

  std::uint64_t task;  ///< see task_fingerprint
  SearchTree tree;
  std::map<std::string, std::int64_t> refusals;  ///< by reason
  std::int64_t expanded = 0, evaluated = 0, trials = 0;
  std::vector<Eigen::Vector3d> directions;  ///< that it starts from
};

/// Of the shape at rest with its structure, the requirements and the options, but for the limits: a search
/// may go on with other ones.
std::uint64_t task_fingerprint(const RequirementChecker& checker, const BestFirstOptions& options);

/// As JSON: numbers round-trip, the same bytes for the same state.
std::string text_of(const SearchState& state);

/// What a saved search must belong to.
struct SearchTask {
  std::uint64_t fingerprint;                ///< see task_fingerprint
  std::vector<Eigen::Vector3d> directions;  ///< that it starts from
  std::vector<Handle> handles;              ///< that its edits may take hold of
};

SearchTask search_task(const RequirementChecker& checker, const BestFirstOptions& options);

/// Throws SavedSearchError when the text is no state, or that of another task.
SearchState read_state(const SavedSearch& saved, const SearchTask& task);

}  // namespace stackabilization::detail
