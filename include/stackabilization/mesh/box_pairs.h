#pragma once

#include <Eigen/Geometry>
#include <cstddef>
#include <optional>
#include <utility>
#include <vector>

namespace stackabilization {

/// Pairs of boxes. Rows ascend within a pair and between pairs.
using BoxPairs = std::vector<std::pair<int, int>>;

/// Returns all pairs of `boxes` whose extents come within `reach` of each other along every axis. Touching
/// boxes are a pair; an empty box is in no pair. Returns nothing when there are more than `max_pairs`; the
/// search stops then. Uses CGAL's box intersection, in time nearly linear in the numbers of boxes and pairs.
/// Precondition: `reach` is finite and not negative.
std::optional<BoxPairs> near_boxes(const std::vector<Eigen::AlignedBox3d>& boxes, double reach,
                                   std::size_t max_pairs);

}  // namespace stackabilization
