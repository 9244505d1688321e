#pragma once

#include <memory>
#include <string>
#include <vector>

#include "stackabilization/structure/structure.h"

namespace stackabilization {

/// A structure as a graph: parts are nodes, relations edges, a self-symmetry a loop. What propagation walks
/// along.
class RelationGraph {
 public:
  /// Precondition: every relation refers to existing parts (`validate`).
  explicit RelationGraph(const Structure& structure);

  /// Rows of Structure::relations that name `part`, each once, in the order in which propagation follows
  /// them: symmetries, self-symmetries, then joints, in each by row.
  const std::vector<int>& incident(int part) const;

  /// The part at the other end of `relation`, one of `incident(part)`; `part` itself for a self-symmetry.
  int opposite(int relation, int part) const;

  /// Parts that `part` has a relation with, in order, without itself.
  std::vector<int> neighbours(int part) const;

  /// Per part the number of its connected component; numbers are given in the order of the parts.
  std::vector<int> components() const;

 private:
  struct Data;
  std::shared_ptr<const Data> data_;
};

/// The graph in the DOT language, for Graphviz: a box for a cuboid, an ellipse for a cylinder; a double line
/// for a symmetric pair, a dotted one for a self-symmetry, green for point joints, red for line joints.
/// Deterministic.
std::string graphviz(const Structure& structure);

}  // namespace stackabilization
