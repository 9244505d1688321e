#pragma once

#include <memory>
#include <string>
#include <vector>

#include "stackabilization/structure/structure.h"

namespace stackabilization {

/// Graph of a structure. The parts are nodes, the relations are edges, and a self-symmetry is a loop.
/// Propagation follows the edges of this graph.
class RelationGraph {
 public:
  /// Precondition: every relation refers to existing parts (`validate`).
  explicit RelationGraph(const Structure& structure);

  /// Returns the rows of Structure::relations that name `part`, each row once. The order is that of
  /// propagation: symmetries, self-symmetries, joints, and by row within each type.
  const std::vector<int>& incident(int part) const;

  /// Returns the part at the other end of `relation`, and `part` itself for a self-symmetry. Precondition:
  /// `relation` is in `incident(part)`.
  int opposite(int relation, int part) const;

  /// Returns the other parts that share a relation with `part`, ascending.
  std::vector<int> neighbours(int part) const;

  /// Returns the connected component of every part. Components are numbered in the order of their first
  /// parts.
  std::vector<int> components() const;

 private:
  struct Data;
  std::shared_ptr<const Data> data_;
};

/// Returns the graph in the DOT language of Graphviz. A cuboid is a box and a cylinder is an ellipse. A
/// symmetric pair is a double line, a self-symmetry is dotted, point joints are green, and line joints are
/// red. Deterministic.
std::string graphviz(const Structure& structure);

}  // namespace stackabilization
