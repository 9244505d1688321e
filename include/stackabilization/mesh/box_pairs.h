#pragma once

#include <Eigen/Geometry>
#include <cstddef>
#include <optional>
#include <utility>
#include <vector>

namespace stackabilization {

/// Pairs of boxes, rows ascending within and between them.
using BoxPairs = std::vector<std::pair<int, int>>;

/// All pairs of `boxes` whose extents come within `reach` of each other along every axis, touching included;
/// empty boxes meet nothing. Nothing when there are more than `max_pairs`: it stops looking then. By CGAL's
/// box intersection, in time near linear in boxes and pairs. Precondition: `reach` is finite and not
/// negative.
std::optional<BoxPairs> near_boxes(const std::vector<Eigen::AlignedBox3d>& boxes, double reach,
                                   std::size_t max_pairs);

}  // namespace stackabilization
