#pragma once

#include <cstdint>
#include <vector>

#include "stackabilization/core/shape.h"
#include "structure/segmentation/surface_graph.h"

/// Not installed.
namespace stackabilization::detail {

/// Cuts a shape whose graph is connected into parts that a cuboid, a solid of revolution or a ring holds; a
/// number per triangle, every part connected.
///
/// 1. Patches: `surface_patches` (Attene et al. 2006), a few hundred.
/// 2. Chords: from points of the surface through the solid behind them (chords.h).
/// 3. Volumes: patches are joined on, cheapest pair first. A pair costs how much emptier its primitive is
/// than
///    those of the two apart (`volume_error`), and a step more where the border between them is concave. The
///    closed faces of a box, and both walls of a vessel, join for nothing; a leg and the top it carries do
///    not.
///
/// `parts` is the number to end with; 0 stops where the root mean square emptiness that a union adds exceeds
/// a fixed share of the bounding-box diagonal. Parts below `smallest` of the area are not counted, and join
/// whatever costs least.
std::vector<std::int32_t> fitted_parts(const Shape& shape, const SurfaceGraph& graph, int parts,
                                       double smallest);

}  // namespace stackabilization::detail
