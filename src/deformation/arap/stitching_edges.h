#pragma once

#include <cstdint>
#include <vector>

#include "mesh/welded_mesh.h"
#include "stackabilization/deformation/as_rigid_as_possible.h"

namespace stackabilization::detail {

/// Computes ties between shells that touch or nearly touch. `shells`: shell number of each welded vertex.
/// Every welded vertex within `reach` (model units) of the surface of another shell is tied to the corners of
/// the nearest triangle of that shell. The weights are the barycentric coordinates of the nearest point.
/// Ordered by welded vertices.
std::vector<StitchingEdge> stitching_edges(const WeldedMesh& places, const std::vector<std::int32_t>& shells,
                                           double reach);

}  // namespace stackabilization::detail
