#pragma once

#include <cstdint>
#include <vector>

#include "envelope/separation/separation_tree.h"
#include "envelope/separation/triangle_pair.h"

namespace stackabilization::detail {

/// A triangle of the copy below and a triangle of the copy above: rows of Shape::triangles, and positions in
/// tree order. A triangle with the same three points as an earlier one has the position of the first one.
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
  /// Whether these are all pairs. Otherwise each triangle has its deepest partner only.
  bool complete = true;
};

/// Returns all pairs of triangles whose height difference over common columns may reach `floor` (a height
/// difference).
///
/// The function falls back to one pair per triangle when there are more than `max_pairs` pairs, or when the
/// search examines `nodes_per_pair` times as many pairs of nodes. Each triangle of the tree, as upper and as
/// lower one, then has the pair with the largest difference, up to `resolution`, found within at most
/// `max_partners` nodes. Of several such pairs the result has one, the same in every run. Of triangles with
/// the same three points, the first one represents all.
ContactPairs contact_pairs(const SeparationTree::Data& tree, const Projection& projection, double floor,
                           std::int64_t max_pairs, double resolution);

inline constexpr int nodes_per_pair = 16;
inline constexpr int max_partners = 4096;

}  // namespace stackabilization::detail
