#pragma once

#include <cstdint>
#include <vector>

#include "stackabilization/core/shape.h"
#include "structure/segmentation/surface_graph.h"

/// Not installed.
namespace stackabilization::detail {

/// Number of the patch per triangle, at most `count` patches per connected graph: hierarchical face
/// clustering after Attene, Falcidieno, Spagnuolo, Hierarchical mesh segmentation based on fitting primitives
/// (2006). Every triangle starts alone; the link whose union is nearest to a plane, sphere or cylinder is
/// contracted, until `count` are left. Where several unions fit equally well, as on a flat face, the more
/// compact one wins.
std::vector<std::int32_t> surface_patches(const Shape& shape, const SurfaceGraph& graph, int count);

}  // namespace stackabilization::detail
