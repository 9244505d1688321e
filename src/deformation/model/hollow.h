#pragma once

#include <Eigen/Core>

#include "stackabilization/structure/structure.h"

namespace stackabilization::detail {

/// Finds the wall of a vessel: across the curve, from points between neighbouring sections, most rays meet a
/// first surface and then, near the radius of the section, a second one. Returns
/// GeneralizedCylinder::inner_radii; empty if there is no wall, as in solid bodies and in walls that are
/// single sheets. `part`: the part as a shape of its own. Deterministic.
Eigen::VectorXd inner_radii(const Shape& part, const GeneralizedCylinder& cylinder);

/// Gives all hollow parts their inner radii, so that edits keep the thickness of walls.
void keep_walls(StructuredShape& structured);

}  // namespace stackabilization::detail
