#pragma once

#include <memory>
#include <vector>

#include "stackabilization/improvement/history.h"

namespace stackabilization::editing {

/// Designs of the nodes of a history, each made once. The history only grows.
class NodeDesigns {
 public:
  /// Returns the design of a node: that of its parent with the edits of the node. Throws as `design_at`.
  std::shared_ptr<const Design> of(const DeformationModel& space, const History& history, int node);
  /// Remembers the design of a node that was made already.
  void remember(int node, std::shared_ptr<const Design> design);

 private:
  std::vector<std::shared_ptr<const Design>> designs_;
};

}  // namespace stackabilization::editing
