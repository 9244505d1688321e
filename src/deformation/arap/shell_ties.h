#pragma once

#include <cstdint>
#include <vector>

#include "mesh/welded_mesh.h"
#include "stackabilization/deformation/as_rigid_as_possible.h"

namespace stackabilization::detail {

/// Ties between shells (`shells`, a number per place) that touch or nearly so: every place that is within
/// `reach` (model units) of the surface of another shell is tied to the corners of the triangle that it is
/// nearest to there, with the weights that these have in the nearest point. Ordered by places.
std::vector<Tie> shell_ties(const WeldedMesh& places, const std::vector<std::int32_t>& shells, double reach);

}  // namespace stackabilization::detail
