#include "envelope/separation/touching_pairs.h"

#include <algorithm>
#include <cmath>
#include <span>
#include <utility>
#include <vector>

#include "envelope/separation/node_pair.h"

namespace stackabilization::detail {
namespace {

using NodePair = std::pair<std::int32_t, std::int32_t>;

/// The projected nodes of a tree that were seen last. A descent sees most nodes a few times in a row; to keep
/// all of them would take more memory than the tree.
class RecentNodes {
 public:
  RecentNodes(const std::vector<TreeNode>& nodes, const Projection& projection)
      : nodes_(nodes),
        projection_(projection),
        indices_(std::min(nodes.size(), max_kept), -1),
        projected_(indices_.size()) {}

  /// Returns a node; valid until the next call.
  const ProjectedNode& operator[](std::int32_t index) {
    const std::size_t slot = static_cast<std::size_t>(index) % indices_.size();
    if (indices_[slot] != index) {
      projected_[slot] = ProjectedNode(nodes_[index], projection_);
      indices_[slot] = index;
    }
    return projected_[slot];
  }

 private:
  static constexpr std::size_t max_kept = 1 << 14;

  const std::vector<TreeNode>& nodes_;
  const Projection& projection_;
  std::vector<std::int32_t> indices_;
  std::vector<ProjectedNode> projected_;
};

/// Finds the pairs by descending two trees against each other, as long as there are not too many.
class PairSearch {
 public:
  PairSearch(const SeparationTree::Data& upper, const SeparationTree::Data& lower,
             const Projection& projection, double floor, std::int64_t max_pairs)
      : upper_(upper),
        lower_(lower),
        projection_(projection),
        bound_(std::max(upper.magnitude, lower.magnitude)),
        upper_nodes_(upper.nodes, projection),
        lower_nodes_(lower.nodes, projection),
        cut_{std::nextafter(floor, -infinity), 0},
        max_pairs_(max_pairs) {}

  /// False when there are too many.
  bool run() {
    std::vector<NodePair> open{{0, 0}};
    for (std::int64_t visited = 0; !open.empty(); ++visited) {
      if (visited > nodes_per_pair * max_pairs_) return false;
      const auto [a, b] = open.back();
      open.pop_back();
      if (bound_(upper_nodes_[a], lower_nodes_[b], cut_) <= cut_) continue;
      const TreeNode &upper = upper_.nodes[a], &lower = lower_.nodes[b];
      if (upper.count > 0 && lower.count > 0) {
        if (!collect(upper, lower)) return false;
      } else if (lower.count > 0 || (upper.count == 0 && a <= b)) {
        open.push_back({upper.first, b});
        open.push_back({upper.first + 1, b});
      } else {
        open.push_back({a, lower.first});
        open.push_back({a, lower.first + 1});
      }
    }
    return true;
  }

  std::vector<ContactPair> take() {
    std::sort(pairs_.begin(), pairs_.end());
    return std::move(pairs_);
  }

 private:
  bool collect(const TreeNode& upper, const TreeNode& lower) {
    for (std::int32_t a = upper.first; a < upper.first + upper.count; ++a)
      for (std::int32_t b = lower.first; b < lower.first + lower.count; ++b)
        if (!collect(a, b)) return false;
    return true;
  }

  /// All pairs of triangles with these points, if they may touch; places in tree order.
  bool collect(std::int32_t a, std::int32_t b) {
    const TreeTriangle &above = upper_.triangles[a], &beneath = lower_.triangles[b];
    if (bound_pair(ProjectedTriangle(above, projection_), ProjectedTriangle(beneath, projection_),
                   projection_, cut_)
            .high <= cut_)
      return true;
    const std::int32_t upper = above.index, lower = beneath.index;
    const std::span<const TriangleCopy> upper_copies = copies_of(upper_, upper),
                                        lower_copies = copies_of(lower_, lower);
    const std::size_t count = (1 + upper_copies.size()) * (1 + lower_copies.size());
    if (static_cast<std::int64_t>(pairs_.size() + count) > max_pairs_) return false;
    // The copies first, then the triangle itself.
    for (std::size_t one = 0; one <= upper_copies.size(); ++one)
      for (std::size_t other = 0; other <= lower_copies.size(); ++other)
        pairs_.push_back({one == upper_copies.size() ? upper : upper_copies[one].copy,
                          other == lower_copies.size() ? lower : lower_copies[other].copy, a, b});
    return true;
  }

  static std::span<const TriangleCopy> copies_of(const SeparationTree::Data& tree, std::int32_t triangle) {
    const auto [first, last] =
        std::equal_range(tree.copies.begin(), tree.copies.end(), TriangleCopy{triangle, 0},
                         [](const TriangleCopy& x, const TriangleCopy& y) { return x.first < y.first; });
    return {first, last};
  }

  const SeparationTree::Data& upper_;
  const SeparationTree::Data& lower_;
  const Projection& projection_;
  NodePairBound bound_;
  RecentNodes upper_nodes_, lower_nodes_;
  DoubleDouble cut_;  ///< just below the floor
  std::int64_t max_pairs_;
  std::vector<ContactPair> pairs_;
};

}  // namespace

ContactPairs touching_pairs(const SeparationTree::Data& upper, const SeparationTree::Data& lower,
                            const Projection& projection, double floor, std::int64_t max_pairs) {
  PairSearch search(upper, lower, projection, floor, max_pairs);
  const bool complete = search.run();
  return {search.take(), complete};
}

}  // namespace stackabilization::detail
