#pragma once

#include <cstdint>
#include <vector>

#include "stackabilization/core/shape.h"
#include "structure/segmentation/surface_graph.h"

namespace stackabilization::detail {

/// Computes the patch of every triangle, with at most `count` patches per connected graph, by hierarchical
/// face clustering after Attene, Falcidieno, Spagnuolo, Hierarchical mesh segmentation based on fitting
/// primitives (2006). Every triangle starts as a patch. The function repeatedly contracts the link whose
/// union is nearest to a plane, sphere or cylinder, until `count` patches are left. Of equally good unions,
/// as on a flat face, the more compact one is chosen.
std::vector<std::int32_t> surface_patches(const Shape& shape, const SurfaceGraph& graph, int count);

}  // namespace stackabilization::detail
