#pragma once

#include <cstdint>
#include <vector>

#include "envelope/separation/exact_pair.h"
#include "envelope/separation/triangle_pair.h"

namespace stackabilization::detail {

/// The triangles of a tree that are edge-on and so share no columns of positive width with anything; none in
/// closed semantics, where width does not matter. Each is decided on first use, in rational arithmetic where
/// the filter cannot tell: a wall along r is met once per neighbour.
class EdgeOnTriangles {
 public:
  EdgeOnTriangles(const std::vector<TreeTriangle>& triangles, const Projection& projection)
      : triangles_(triangles), projection_(projection) {}

  /// `seen`: the triangle with this index, projected.
  bool contains(std::int32_t index, const ProjectedTriangle& seen) {
    if (!seen.possibly_edge_on() || projection_.semantics == ContactSemantics::closed) return false;
    if (states_.empty()) states_.assign(triangles_.size(), State::unknown);
    State& state = states_[index];
    if (state == State::unknown)
      state = is_edge_on(triangles_[index], projection_.shear) ? State::yes : State::no;
    return state == State::yes;
  }

  /// Decides all triangles, and so which nodes of their tree have no others.
  void decide_nodes(const std::vector<TreeNode>& nodes) {
    whole_nodes_.assign(nodes.size(), 1);
    for (std::size_t n = nodes.size(); n-- > 0;) {  // children come after their parent
      const TreeNode& node = nodes[n];
      if (node.count == 0) whole_nodes_[n] = whole_nodes_[node.first] & whole_nodes_[node.first + 1];
      for (std::int32_t t = node.first; t < node.first + node.count; ++t)
        if (!contains(t, ProjectedTriangle(triangles_[t], projection_))) whole_nodes_[n] = 0;
    }
  }

  bool nodes_decided() const { return !whole_nodes_.empty(); }
  /// Whether all triangles of a node are edge-on, as far as the nodes are decided.
  bool contains_node(std::int32_t node) const { return nodes_decided() && whole_nodes_[node] != 0; }

 private:
  enum class State : char { unknown, yes, no };

  const std::vector<TreeTriangle>& triangles_;
  const Projection& projection_;
  std::vector<State> states_;
  std::vector<char> whole_nodes_;
};

}  // namespace stackabilization::detail
