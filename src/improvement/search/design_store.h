#pragma once

#include <cstddef>
#include <list>
#include <map>
#include <memory>
#include <utility>

#include "improvement/search/search_tree.h"
#include "stackabilization/improvement/requirements.h"

namespace stackabilization::detail {

/// Cache of the designs of search nodes. Keeps the most recently used designs within a fixed amount of
/// memory. Other designs are made again from their nearest cached ancestor: equal to the bit, since edits are
/// deterministic.
class DesignStore {
 public:
  DesignStore(const RequirementChecker& checker, const SearchTree& tree) : checker_(checker), tree_(tree) {}

  /// Returns the design of a node. Throws InputError when an edit of the tree is refused: the tree then
  /// belongs to another task.
  std::shared_ptr<const Design> of(int node);
  /// Adds the design of a node to the cache.
  void keep(int node, Design design);

 private:
  struct Kept {
    int node;
    std::shared_ptr<const Design> design;
    std::size_t bytes;
  };

  std::shared_ptr<const Design> keep(int node, std::shared_ptr<const Design> design);

  const RequirementChecker& checker_;
  const SearchTree& tree_;
  std::list<Kept> kept_;  ///< most recently used first
  std::map<int, std::list<Kept>::iterator> rows_;
  std::size_t bytes_ = 0;
};

}  // namespace stackabilization::detail
