#pragma once

#include <cstdint>
#include <vector>

#include "stackabilization/core/shape.h"
#include "structure/segmentation/surface_graph.h"

/// Not installed.
namespace stackabilization::detail {

/// Segmentation by the shape-diameter function (Shapira et al. 2008) as CGAL has it, of the surface turned
/// outward; a number per triangle. `parts` is the number to end with: CGAL's number of clusters is raised
/// until there are as many segments, then the smallest join a neighbour; 0 leaves CGAL its default of five
/// clusters. Where CGAL finds no diameter (sheets, surfaces of a few triangles) the piece stays one part.
std::vector<std::int32_t> shape_diameter_parts(const Shape& shape, const SurfaceGraph& graph, int parts);

}  // namespace stackabilization::detail
