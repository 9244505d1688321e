#pragma once

#include <cstddef>
#include <list>
#include <map>
#include <memory>
#include <utility>

#include "improvement/search/search_tree.h"
#include "stackabilization/improvement/requirements.h"

namespace stackabilization::detail {

/// Designs of the nodes of a search. As many as fit in a fixed amount of memory are kept, those last used;
/// others are made again from their nearest ancestor that is: the same to the bit, since edits are
/// deterministic.
class DesignStore {
 public:
  DesignStore(const RequirementChecker& checker, const SearchTree& tree) : checker_(checker), tree_(tree) {}

  /// Throws InputError when an edit of the tree is refused: it comes from elsewhere.
  std::shared_ptr<const Design> of(int node);
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
  std::list<Kept> kept_;  ///< last used first
  std::map<int, std::list<Kept>::iterator> rows_;
  std::size_t bytes_ = 0;
};

}  // namespace stackabilization::detail
