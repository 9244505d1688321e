#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "stackabilization/improvement/design.h"

namespace stackabilization {

/// One step of an editing session.
struct HistoryNode {
  int parent = -1;          ///< row of History::nodes; -1 for the root, the shape at rest
  std::vector<Edit> edits;  ///< made on top of the parent's design; none for the root
  std::string name;         ///< for people; may be empty
  Eigen::Vector3d direction = Eigen::Vector3d::UnitZ();  ///< r along which it was measured
  double stackability = 0;                               ///< S(M, r)
  double energy = 0;                                     ///< E(M)
};

/// The tree of all designs that were tried; the first node is the shape at rest. Nodes are never changed or
/// removed: rolling back makes another one current.
struct History {
  std::vector<HistoryNode> nodes;
  int current = 0;
};

/// All edits from rest to a node. Throws UsageError when there is none.
std::vector<Edit> edits_to(const History& history, int node);

/// A structured shape with the history of its designs: what `suggest` and an interactive editor work on.
struct Project {
  StructuredShape rest;
  History history;
  DeformationKind kind = DeformationKind::controllers;
};

}  // namespace stackabilization
