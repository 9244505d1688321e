#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <optional>
#include <set>
#include <string>
#include <unordered_set>
#include <utility>
#include <vector>

#include "stackabilization/improvement/energy.h"
#include "stackabilization/stacking/stackability.h"

namespace stackabilization::detail {

enum class NodeState {
  queued,
  expanded,
  solution,
  repeated,  ///< reaches the target, but so does a solution that is much the same
};

/// A candidate of a search: how it was made of its parent, and how good it is. Its configuration follows from
/// the edits from the root, and is not kept.
struct SearchNode {
  int parent = -1;  ///< -1 for a root: the shape at rest along one of the starting directions
  int queue = 0;    ///< row of the starting directions
  Edit edit;  ///< of the parent's design, under the constraints for the parent's direction; none for a root
  std::string why;                                       ///< see ContactEdit::why
  Eigen::Vector3d direction = Eigen::Vector3d::UnitZ();  ///< r, for its measures and for its successors
  Stackability measured;
  Energy energy;
  std::uint64_t key = 0;  ///< see ConfigurationKeys
  NodeState state = NodeState::queued;
};

/// All candidates of a search, with one queue of least E per starting direction (ties: made first). The
/// queues take turns.
class SearchTree {
 public:
  explicit SearchTree(int queues) : queues_(static_cast<std::size_t>(queues)), known_(queues_.size()) {}

  const std::vector<SearchNode>& nodes() const { return nodes_; }
  const SearchNode& node(int id) const { return nodes_[static_cast<std::size_t>(id)]; }
  int count() const { return static_cast<int>(nodes_.size()); }
  int turn() const { return turn_; }
  std::int64_t queued() const;

  /// The one to be looked at next.
  std::optional<int> next() const;
  /// Whether a configuration was met before in this queue.
  bool knows(int queue, std::uint64_t key) const {
    return known_[static_cast<std::size_t>(queue)].contains(key);
  }
  /// Its id: the number of nodes before it. It is queued where its state says so.
  int add(SearchNode node);
  /// Takes `id` out of its queue and gives the turn to the next one. Precondition: `id` is `next()`.
  void settle(int id, NodeState state);
  /// The same candidate seen along another direction. Precondition: `id` is not queued.
  void turn_to(int id, const Stackability& measured, const Energy& energy);
  void set_turn(int queue) { turn_ = queue; }

  /// Rows from below the root to `id`: one per edit.
  std::vector<int> path(int id) const;

 private:
  std::vector<SearchNode> nodes_;
  std::vector<std::set<std::pair<double, int>>> queues_;
  std::vector<std::unordered_set<std::uint64_t>> known_;
  int turn_ = 0;
};

}  // namespace stackabilization::detail
