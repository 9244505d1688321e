#pragma once

#include <cstdint>
#include <vector>

#include "structure/segmentation/surface_graph.h"

namespace stackabilization::detail {

/// Returns the concavity of a link: 0 for flat and convex edges, 1 from 90 degrees on.
double concavity(const SurfaceLink& link);

/// Returns the cost of a cut along a link: its length, reduced down to a tenth of it for the most concave
/// edges.
double cutting_cost(const SurfaceLink& link);

/// Moves the boundary between any two neighbouring parts to the cheapest cut near it: a short cut along
/// concave edges (minimum cut, after Katz and Tal 2003). Triangles with `fixed` set keep their part. `fixed`
/// may be empty.
std::vector<std::int32_t> with_smooth_boundaries(const SurfaceGraph& graph, std::vector<std::int32_t> part,
                                                 const std::vector<char>& fixed);

/// Merges small segments: every part of the result that has neighbours is connected and has at least the area
/// `min_area` (model units squared). A smaller piece joins the neighbour with the strongest link to it; the
/// smallest piece is merged first. A piece without area and neighbours, such as a shell of one flat triangle,
/// joins the largest piece. Parts are renumbered in the order of their first triangles.
std::vector<std::int32_t> merge_small_segments(const SurfaceGraph& graph,
                                               const std::vector<std::int32_t>& part, double min_area);

}  // namespace stackabilization::detail
