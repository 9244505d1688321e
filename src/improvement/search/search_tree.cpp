#include "improvement/search/search_tree.h"

#include <algorithm>

namespace stackabilization::detail {

std::int64_t SearchTree::queued() const {
  std::size_t count = 0;
  for (const auto& queue : queues_) count += queue.size();
  return static_cast<std::int64_t>(count);
}

std::optional<int> SearchTree::next() const {
  for (std::size_t k = 0; k < queues_.size(); ++k) {
    const auto& queue = queues_[(static_cast<std::size_t>(turn_) + k) % queues_.size()];
    if (!queue.empty()) return queue.begin()->second;
  }
  return std::nullopt;
}

int SearchTree::add(SearchNode node) {
  const int id = static_cast<int>(nodes_.size());
  const auto queue = static_cast<std::size_t>(node.queue);
  known_[queue].insert(node.key);
  if (node.state == NodeState::queued) queues_[queue].emplace(node.energy.value, id);
  nodes_.push_back(std::move(node));
  return id;
}

void SearchTree::settle(int id, NodeState state) {
  SearchNode& node = nodes_[static_cast<std::size_t>(id)];
  queues_[static_cast<std::size_t>(node.queue)].erase({node.energy.value, id});
  node.state = state;
  turn_ = (node.queue + 1) % static_cast<int>(queues_.size());
}

void SearchTree::turn_to(int id, const Stackability& measured, const Energy& energy) {
  SearchNode& node = nodes_[static_cast<std::size_t>(id)];
  node.direction = measured.direction;
  node.measured = measured;
  node.energy = energy;
}

std::vector<int> SearchTree::path(int id) const {
  std::vector<int> rows;
  for (; node(id).parent >= 0; id = node(id).parent) rows.push_back(id);
  std::reverse(rows.begin(), rows.end());
  return rows;
}

}  // namespace stackabilization::detail
