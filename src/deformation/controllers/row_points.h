#pragma once

#include <vector>

#include "deformation/controllers/rig.h"

namespace stackabilization::detail {

/// Returns points of every three consecutive parts of every row of parts (structure/part_rows.h), but for
/// images of others under the symmetries: four of boxes, five of generalized cylinders, which say where a
/// part is and what form it has as far as affine maps change it. Precondition: `rest`, `space` and
/// `primitive_bindings` of `rig` are set.
std::vector<RowPoint> row_points(const Rig& rig);

}  // namespace stackabilization::detail
