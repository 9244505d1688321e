#pragma once

#include <vector>

#include "deformation/controllers/rig.h"

namespace stackabilization::detail {

/// Returns the row points of all rows of parts (structure/part_rows.h) that no symmetry makes the same: four
/// points of every three consecutive parts, which say where a box or a straight cylinder is and what form it
/// has, and one more for a curved cylinder. Precondition: `space` and `primitive_bindings` of `rig` are set.
std::vector<RowPoint> row_points(const Rig& rig);

/// Returns by how much the steps of a row differ at a row point, against rest. `now`: one primitive per part.
Eigen::Vector3d unevenness(const Rig& rig, const RowPoint& point, const std::vector<Primitive>& now);

}  // namespace stackabilization::detail
