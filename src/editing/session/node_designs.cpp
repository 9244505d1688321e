#include "editing/session/node_designs.h"

#include <utility>

namespace stackabilization::editing {

std::shared_ptr<const Design> NodeDesigns::of(const DeformationModel& space, const History& history,
                                              int node) {
  const auto row = static_cast<std::size_t>(node);
  if (node < 0 || row >= designs_.size() || !designs_[row])
    remember(node, std::make_shared<const Design>(design_at(space, history, node)));
  return designs_[row];
}

void NodeDesigns::remember(int node, std::shared_ptr<const Design> design) {
  const auto row = static_cast<std::size_t>(node);
  if (row >= designs_.size()) designs_.resize(row + 1);
  designs_[row] = std::move(design);
}

}  // namespace stackabilization::editing
