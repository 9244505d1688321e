#include "stackabilization/improvement/history.h"

#include <algorithm>

#include "stackabilization/core/errors.h"

namespace stackabilization {

namespace {

void expect_node(const History& history, int node) {
  if (node < 0 || static_cast<std::size_t>(node) >= history.nodes.size())
    throw UsageError("the history has no node " + std::to_string(node) + ", only " +
                     std::to_string(history.nodes.size()) + " counted from 0");
}

/// Returns the rows from the root to a node.
std::vector<int> path_to(const History& history, int node) {
  expect_node(history, node);
  std::vector<int> path;
  while (node >= 0) {
    path.push_back(node);
    const int parent = history.nodes[static_cast<std::size_t>(node)].parent;
    if (parent >= node)
      throw UsageError("node " + std::to_string(node) + " of the history has the parent " +
                       std::to_string(parent) + ", which is not above it");
    node = parent;
  }
  std::reverse(path.begin(), path.end());
  return path;
}

}  // namespace

std::vector<Edit> edits_to(const History& history, int node) {
  std::vector<Edit> edits;
  for (const int row : path_to(history, node)) {
    const std::vector<Edit>& more = history.nodes[static_cast<std::size_t>(row)].edits;
    edits.insert(edits.end(), more.begin(), more.end());
  }
  return edits;
}

History apply(History history, HistoryNode child) {
  expect_node(history, history.current);
  child.parent = history.current;
  history.current = static_cast<int>(history.nodes.size());
  history.nodes.push_back(std::move(child));
  return history;
}

History roll_back(History history, int node) {
  expect_node(history, node);
  history.current = node;
  return history;
}

Design design_at(const DeformationModel& space, const History& history, int node) {
  Design design = space.at_rest();
  for (const int row : path_to(history, node)) {
    const HistoryNode& step = history.nodes[static_cast<std::size_t>(row)];
    const std::string place = "node " + std::to_string(row) + " of the history cannot be made again: ";
    for (const Edit& edit : step.edits) {
      DeformationResult outcome = [&] {
        try {
          return space.edited(design, edit, step.constraints);
        } catch (const UsageError& error) {
          throw InputError(place + error.what());
        }
      }();
      if (outcome.refusal) throw InputError(place + describe(*outcome.refusal, space.rest().structure));
      design = std::move(outcome.design);
    }
  }
  return design;
}

}  // namespace stackabilization
