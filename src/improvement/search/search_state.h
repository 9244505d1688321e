#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include "improvement/search/search_tree.h"
#include "stackabilization/improvement/best_first.h"

namespace stackabilization::detail {

/// State of a search between two steps, without what can be computed from it.
struct SearchState {
  SearchState(std::uint64_t the_task, std::vector<Eigen::Vector3d> the_directions)
      : task(the_task),
        tree(static_cast<int>(the_directions.size())),
        directions(std::move(the_directions)) {}

  std::uint64_t task;  ///< see task_fingerprint
  SearchTree tree;
  std::map<Obstacle, std::int64_t> refusals;  ///< counts, see ObstacleCount
  std::int64_t expanded = 0, evaluated = 0, trials = 0;
  std::vector<Eigen::Vector3d> directions;  ///< starting directions
};

/// Returns a fingerprint of the shape at rest with its structure, the requirements and the options. The
/// limits are left out: a resumed search may have others.
std::uint64_t task_fingerprint(const RequirementChecker& checker, const BestFirstOptions& options);

/// Returns the state as JSON. Numbers round-trip; equal states give equal bytes. `part_names`: those of the
/// shape at rest.
std::string text_of(const SearchState& state, const std::vector<std::string>& part_names);

/// Task to which a saved search must belong. `rest` must outlive it.
struct SearchTask {
  std::uint64_t fingerprint;                ///< see task_fingerprint
  std::vector<Eigen::Vector3d> directions;  ///< starting directions
  std::vector<Handle> handles;              ///< handles that its edits may use
  const StructuredShape& rest;              ///< shape at rest
  DeformationCapabilities capabilities;     ///< those of the deformation model
};

SearchTask search_task(const RequirementChecker& checker, const BestFirstOptions& options);

/// Reads a saved search. Throws SavedSearchError when the text is no search state, or belongs to another
/// task.
SearchState read_state(const SavedSearch& saved, const SearchTask& task);

}  // namespace stackabilization::detail
