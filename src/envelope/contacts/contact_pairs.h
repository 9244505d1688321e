#pragma once

#include <cstdint>
#include <vector>

#include "envelope/separation/separation_tree.h"
#include "envelope/separation/triangle_pair.h"

namespace stackabilization::detail {

/// A triangle of the copy below and one of the copy above: rows of Shape::triangles, and where the triangle,
/// or the first with the same three points, lies in tree order.
struct ContactPair {
  std::int32_t upper, lower;
  std::int32_t upper_at, lower_at;

  friend bool operator<(const ContactPair& a, const ContactPair& b) {
    return a.upper != b.upper ? a.upper < b.upper : a.lower < b.lower;
  }
};

/// Pairs of triangles in the order of their rows.
struct ContactPairs {
  std::vector<ContactPair> pairs;
  bool complete = true;  ///< these are all; else each triangle has its deepest partner alone
};

/// All pairs of triangles over whose common columns the height difference may reach `floor` (as a height
/// difference). If these are more than `max_pairs`, or finding them takes `nodes_per_pair` times as many
/// pairs of nodes, then instead for each triangle of the tree, as upper and as lower one, the pair with the
/// largest difference, up to `resolution`, looked for in at most `max_partners` nodes; where several have it,
/// one of them, the same in every run. Of triangles with the same three points the first stands for all then.
ContactPairs contact_pairs(const SeparationTree::Data& tree, const Projection& projection, double floor,
                           std::int64_t max_pairs, double resolution);

inline constexpr int nodes_per_pair = 16;
inline constexpr int max_partners = 4096;

}  // namespace stackabilization::detail
