#pragma once

#include <cstdint>

#include "envelope/separation/touching_pairs.h"

namespace stackabilization::detail {

/// Returns all pairs of triangles of a shape and its copy whose height difference over common columns may
/// reach `floor` (a height difference).
///
/// The function falls back to one pair per triangle, and says that the pairs are not complete, where
/// `touching_pairs` does not find all of them. Each triangle of the tree, as upper and as
/// lower one, then has the pair with the largest difference, up to `resolution`, found within at most
/// `max_partners` nodes. Of several such pairs the result has one, the same in every run. Of triangles with
/// the same three points, the first one represents all.
ContactPairs contact_pairs(const SeparationTree::Data& tree, const Projection& projection, double floor,
                           std::int64_t max_pairs, double resolution);

inline constexpr int max_partners = 4096;

}  // namespace stackabilization::detail
