#pragma once

#include <cstdint>
#include <vector>

#include "stackabilization/core/shape.h"
#include "structure/segmentation/surface_graph.h"

namespace stackabilization::detail {

/// Segments a shape by the shape-diameter function (Shapira et al. 2008) in CGAL's implementation, after the
/// surface was oriented outward. Returns the part of every triangle. `parts`: number of parts of the result.
/// The function raises CGAL's number of clusters until there are as many segments; then the smallest segments
/// join a neighbour. 0: CGAL's default of five clusters. A piece for which CGAL computes no diameter (a
/// sheet, a surface of a few triangles) stays one part.
std::vector<std::int32_t> shape_diameter_parts(const Shape& shape, const SurfaceGraph& graph, int parts);

}  // namespace stackabilization::detail
