#pragma once

#include <cstdint>
#include <vector>

#include "stackabilization/core/shape.h"
#include "structure/segmentation/surface_graph.h"

namespace stackabilization::detail {

/// Size of the shape against which the fit of its parts is measured.
struct WholeSize {
  double area;      ///< of the surface, model units squared
  double diagonal;  ///< of the bounding box, model units
};

/// Cuts a shape into parts that fit a cuboid, a solid of revolution or a ring. Returns the part of every
/// triangle; every part is connected. Precondition: the graph is connected.
///
/// 1. Patches: `surface_patches` computes a few hundred patches (Attene et al. 2006).
/// 2. Chords: `chords` measures the solid behind points of the surface.
/// 3. Volumes: the function merges neighbouring patches, cheapest pair first. The cost of a pair is the
///    increase of `volume_error` over the two patches apart, plus a fixed step when the border between them
///    is concave. The closed faces of a box merge at no cost, and so do both walls of a vessel. A leg and its
///    table top do not merge.
///
/// `parts`: number of parts of the result. 0: merging stops where the root mean square of the added empty
/// length exceeds a fixed fraction of the diagonal of `whole`, over its area. Parts smaller than `smallest`
/// (fraction of the area of `whole`) do not count; they join the neighbour of least cost.
///
/// `whole`: the size of the shape, or of the one that it was cut from.
std::vector<std::int32_t> fitted_parts(const Shape& shape, const SurfaceGraph& graph, int parts,
                                       double smallest, const WholeSize& whole);

}  // namespace stackabilization::detail
