#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "envelope/separation/node_pair.h"
#include "envelope/separation/separation_tree.h"
#include "stackabilization/core/direction.h"

namespace stackabilization::detail {

/// Lower bounds of the separation of a shape from its copy that hold for a whole cone of directions.
///
/// The translations at which two triangles touch form a convex set, the Minkowski difference of the two. A
/// pair of triangles that touches at t_i r_i for the edges r_i of a cone, with all t_i > 0, so touches at
/// t r for every r = sum w_i r_i (weights w_i >= 0 of sum 1), with t = 1 / sum (w_i / t_i): at least the
/// smallest t_i. Two triangles that share columns of positive width along every edge, and turn the same side
/// to all of them, share such columns along every r. So the smallest t_i is a lower bound of sep(M, M, r).
class SeparationOverCone {
 public:
  /// `edges`: the r_i; at least one. `tree` must outlive the object.
  SeparationOverCone(const SeparationTree& tree, const std::vector<Direction>& edges,
                     ContactSemantics semantics);

  /// Searches a pair of triangles that shows a bound of at least `demand` > 0 and returns that bound, in
  /// units of the r above. Examines at most `max_node_pairs` pairs of nodes, those first that leave most room
  /// above the demand. Nothing: there is no such pair, or it was not found. Certified: rounding is allowed
  /// for.
  std::optional<double> at_least(double demand, std::int64_t max_node_pairs);

 private:
  /// A pair of nodes to be examined.
  struct Pair {
    double room;  ///< what its upper bound is above the demand, along the edge where that is least
    std::int32_t upper, lower;
  };
  /// One edge of the cone, with the nodes seen along it.
  struct Edge {
    Projection projection;
    double scale;  ///< heights per unit of r
    ProjectedNodes nodes;
  };

  std::optional<Pair> pair(std::int32_t upper, std::int32_t lower, double demand);
  void split(const Pair& pair, double demand);
  std::optional<double> leaves(const TreeNode& upper, const TreeNode& lower, double demand) const;
  double shown_by(const TreeTriangle& upper, const TreeTriangle& lower, double demand) const;

  const SeparationTree::Data& tree_;
  NodePairBound node_bound_;
  std::vector<Edge> edges_;
  std::vector<Pair> stack_;  ///< pairs that wait; the last is next
};

}  // namespace stackabilization::detail
