#pragma once

#include <cstdint>
#include <vector>

#include "structure/segmentation/surface_graph.h"

/// Not installed.
namespace stackabilization::detail {

/// How concave a link is: 0 when flat or convex, 1 from 90 degrees on.
double concavity(const SurfaceLink& link);

/// What a cut along a link costs: its length, a tenth of it where the edge is as concave as can be.
double cutting_cost(const SurfaceLink& link);

/// Moves the boundary between each two neighbouring parts to the cheapest cut near it: short, along concave
/// edges (minimum cut, after Katz and Tal 2003). Triangles for which `fixed` is set keep their part; it may
/// be empty.
std::vector<std::int32_t> with_smooth_boundaries(const SurfaceGraph& graph, std::vector<std::int32_t> part,
                                                 const std::vector<char>& fixed);

/// Makes every part connected and at least `min_area` large: lesser pieces join the neighbour they are
/// tied to most, the smallest first. Parts are renumbered in order of their first triangles.
std::vector<std::int32_t> merge_small_segments(const SurfaceGraph& graph,
                                               const std::vector<std::int32_t>& part, double min_area);

}  // namespace stackabilization::detail
