#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <optional>
#include <set>
#include <unordered_set>
#include <utility>
#include <vector>

#include "stackabilization/improvement/contact_edits.h"
#include "stackabilization/improvement/energy.h"
#include "stackabilization/stacking/stackability.h"

namespace stackabilization::detail {

/// State of a node in a search.
enum class NodeState {
  queued,
  expanded,
  solution,
  repeated,  ///< reaches the target, but does not differ from an earlier solution
};

/// A candidate of a search: the edit that makes it from its parent, and its measures. Its design follows from
/// the edits from the root and is not stored here.
struct SearchNode {
  int parent = -1;  ///< -1 for a root: the shape at rest along a starting direction
  int queue = 0;    ///< row of the starting direction
  /// Edit of the parent's design, under the constraints for the parent's direction; none for a root.
  Edit edit;
  EditReason reason;
  Eigen::Vector3d direction = Eigen::Vector3d::UnitZ();  ///< r of the measures and for the successors
  Stackability measured;
  Energy energy;
  std::uint64_t key = 0;  ///< see ConfigurationKeys
  NodeState state = NodeState::queued;
};

/// All candidates of a search, with one queue and one visited set per starting direction. A queue yields the
/// candidate of least E (ties: the one made first). The queues take turns.
class SearchTree {
 public:
  explicit SearchTree(int queues) : queues_(static_cast<std::size_t>(queues)), known_(queues_.size()) {}

  const std::vector<SearchNode>& nodes() const { return nodes_; }
  const SearchNode& node(int id) const { return nodes_[static_cast<std::size_t>(id)]; }
  int count() const { return static_cast<int>(nodes_.size()); }
  int turn() const { return turn_; }
  std::int64_t queued() const;

  /// Returns the next candidate to be looked at, if any is queued.
  std::optional<int> next() const;
  /// Returns whether the visited set of a queue has a configuration.
  bool knows(int queue, std::uint64_t key) const {
    return known_[static_cast<std::size_t>(queue)].contains(key);
  }
  /// Adds a node and returns its id, the number of nodes before it. The node is queued if its state says so.
  int add(SearchNode node);
  /// Removes `id` from its queue, sets its state and gives the turn to the next queue. Precondition: `id` is
  /// `next()`.
  void settle(int id, NodeState state);
  /// Replaces the measures of a candidate by those along another direction. Precondition: `id` is not queued.
  void turn_to(int id, const Stackability& measured, const Energy& energy);
  void set_turn(int queue) { turn_ = queue; }

  /// Returns the nodes from below the root to `id`, one per edit.
  std::vector<int> path(int id) const;

 private:
  std::vector<SearchNode> nodes_;
  std::vector<std::set<std::pair<double, int>>> queues_;
  std::vector<std::unordered_set<std::uint64_t>> known_;
  int turn_ = 0;
};

}  // namespace stackabilization::detail
