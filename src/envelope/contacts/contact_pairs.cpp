#include "envelope/contacts/contact_pairs.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "envelope/separation/exact_pair.h"
#include "envelope/separation/node_pair.h"

namespace stackabilization::detail {
namespace {

PairBounds bounds_of(const TreeTriangle& upper, const TreeTriangle& lower, const Projection& projection,
                     const DoubleDouble& cut) {
  return bound_pair(ProjectedTriangle(upper, projection), ProjectedTriangle(lower, projection), projection,
                    cut);
}

enum class Side { upper, lower };

/// Finds the deepest partner of every triangle. "Own" nodes and triangles are on the side of the triangle in
/// question, "partner" ones on the other side.
class DeepestPartners {
 public:
  DeepestPartners(const SeparationTree::Data& tree, const Projection& projection, double floor,
                  double resolution)
      : tree_(tree),
        projection_(projection),
        bound_(tree.magnitude),
        cut_{std::nextafter(floor, -infinity), 0},
        resolution_(resolution) {
    nodes_.reserve(tree.nodes.size());
    for (const TreeNode& node : tree.nodes) nodes_.emplace_back(node, projection);
    touching_.resize(tree.nodes.size());
    for (std::size_t n = tree.nodes.size(); n-- > 0;) {  // children come after their parent
      const TreeNode& node = tree.nodes[n];
      if (node.count == 0) touching_[n] = touching_[node.first] || touching_[node.first + 1];
      for (std::int32_t t = node.first; t < node.first + node.count; ++t)
        touching_[n] = touching_[n] || may_touch(t);
    }
  }

  std::vector<ContactPair> run() const {
    std::array<std::vector<std::int32_t>, 2> partners;
    for (std::vector<std::int32_t>& one : partners) one.assign(tree_.triangles.size(), -1);
    tbb::parallel_for(std::size_t{0}, tree_.nodes.size(), [&](std::size_t leaf) {
      if (tree_.nodes[leaf].count == 0 || !touching_[leaf]) return;
      for (const Side side : {Side::upper, Side::lower})
        find_partners(static_cast<std::int32_t>(leaf), side, partners[static_cast<std::size_t>(side)]);
    });
    std::vector<ContactPair> pairs;
    for (std::int32_t t = 0; t < static_cast<std::int32_t>(tree_.triangles.size()); ++t) {
      add(t, partners[0][t], pairs);
      add(partners[1][t], t, pairs);
    }
    std::sort(pairs.begin(), pairs.end());
    const auto same = [](const ContactPair& a, const ContactPair& b) { return !(a < b); };
    pairs.erase(std::unique(pairs.begin(), pairs.end(), same), pairs.end());
    return pairs;
  }

 private:
  struct Partner {
    double depth = -infinity;
    std::int32_t at = -1;
  };
  using Partners = std::array<Partner, leaf_size>;

  void add(std::int32_t upper, std::int32_t lower, std::vector<ContactPair>& pairs) const {
    if (upper >= 0 && lower >= 0)
      pairs.push_back({tree_.triangles[upper].index, tree_.triangles[lower].index, upper, lower});
  }

  /// In solid semantics walls along r touch nothing.
  bool may_touch(std::int32_t triangle) const {
    if (projection_.semantics == ContactSemantics::closed) return true;
    const ProjectedTriangle seen(tree_.triangles[triangle], projection_);
    return seen.area != 0 || seen.area_error != 0;
  }

  /// -inf where no triangle of the partner may touch.
  DoubleDouble bound(std::int32_t own, std::int32_t partner, Side side) const {
    if (!touching_[partner]) return {-infinity, 0};
    return side == Side::upper ? bound_(nodes_[own], nodes_[partner], cut_)
                               : bound_(nodes_[partner], nodes_[own], cut_);
  }

  void find_partners(std::int32_t leaf, Side side, std::vector<std::int32_t>& found) const {
    const TreeNode& own = tree_.nodes[leaf];
    Partners best;
    for (std::int32_t t = 0; t < own.count; ++t)
      if (!may_touch(own.first + t)) best[t].depth = infinity;
    struct Open {
      DoubleDouble bound;
      std::int32_t node;
    };
    std::vector<Open> open{{bound(leaf, 0, side), 0}};
    for (int visited = 0; !open.empty() && visited < max_partners; ++visited) {
      const Open next = open.back();
      open.pop_back();
      if (next.bound <= cut_ || next.bound.high <= min_depth(best, own.count) + resolution_) continue;
      const TreeNode& node = tree_.nodes[next.node];
      if (node.count > 0) {
        for (std::int32_t own_at = 0; own_at < own.count; ++own_at)
          for (std::int32_t p = node.first; p < node.first + node.count; ++p)
            compare(own.first + own_at, p, side, best[own_at]);
      } else {
        Open first{bound(leaf, node.first, side), node.first};
        Open second{bound(leaf, node.first + 1, side), node.first + 1};
        if (first.bound <= second.bound) std::swap(first, second);
        open.push_back(second);
        open.push_back(first);
      }
    }
    for (std::int32_t t = 0; t < own.count; ++t) found[own.first + t] = best[t].at;
  }

  static double min_depth(const Partners& best, std::int32_t count) {
    double depth = best[0].depth;
    for (std::int32_t t = 1; t < count; ++t) depth = std::min(depth, best[t].depth);
    return depth;
  }

  void compare(std::int32_t own, std::int32_t partner, Side side, Partner& best) const {
    const std::int32_t upper = side == Side::upper ? own : partner;
    const std::int32_t lower = side == Side::upper ? partner : own;
    const TreeTriangle &above = tree_.triangles[upper], &beneath = tree_.triangles[lower];
    const PairBounds bounds = bounds_of(above, beneath, projection_, cut_);
    if (bounds.high <= cut_ || bounds.high.high <= best.depth) return;
    const bool certain = bounds.low.high > -infinity;
    if (!certain && !exact_maximum(above, beneath, projection_.shear, projection_.semantics)) return;
    best = {bounds.high.high, partner};
  }

  const SeparationTree::Data& tree_;
  const Projection& projection_;
  NodePairBound bound_;
  DoubleDouble cut_;  ///< just below the floor
  double resolution_;
  std::vector<ProjectedNode> nodes_;
  std::vector<char> touching_;  ///< per node: some triangle of it may touch
};

}  // namespace

ContactPairs contact_pairs(const SeparationTree::Data& tree, const Projection& projection, double floor,
                           std::int64_t max_pairs, double resolution) {
  ContactPairs all = touching_pairs(tree, tree, projection, floor, max_pairs);
  if (all.complete) return all;
  return {DeepestPartners(tree, projection, floor, resolution).run(), false};
}

}  // namespace stackabilization::detail
