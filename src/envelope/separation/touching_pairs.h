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
  /// Whether these are all pairs.
  bool complete = true;
};

/// Returns all pairs of a triangle of `upper` and one of `lower` whose height difference over common columns
/// may reach `floor` (a height difference). Where there are more than `max_pairs`, or the search examines
/// `nodes_per_pair` times as many pairs of nodes, the result has those that were met by then, the same ones
/// in every run. Both trees have the same origin.
ContactPairs touching_pairs(const SeparationTree::Data& upper, const SeparationTree::Data& lower,
                            const Projection& projection, double floor, std::int64_t max_pairs);

inline constexpr int nodes_per_pair = 16;

}  // namespace stackabilization::detail
