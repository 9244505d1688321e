#pragma once

#include <Eigen/Core>

#include "stackabilization/structure/structure.h"

namespace stackabilization::detail {

/// Finds the wall of a vessel: across the curve, from points between neighbouring sections, most rays meet a
/// first surface and then, near the radius of the section, a second one. Returns
/// GeneralizedCylinder::inner_radii; empty if there is no wall, as in solid bodies and in walls that are
/// single sheets. `part`: the part as a shape of its own. Deterministic.
Eigen::VectorXd inner_radii(const Shape& part, const GeneralizedCylinder& cylinder);

/// Finds the walls of a hollow box: along an axis, from points of the middle plane, most rays in either
/// direction meet a first surface in the outer half of the box and then, near its face, a second one. Returns
/// Cuboid::inner_sides: the innermost places of the walls, rounded corners included; 1 along axes without two
/// walls, such as those through a floor and an opening. `part`: the part as a shape of its own. Precondition:
/// `box` is a box. Deterministic.
Eigen::Matrix<double, 3, 2> inner_sides(const Shape& part, const Cuboid& box);

/// Gives all hollow parts the inner sides of their walls, so that edits keep the thickness of walls.
void keep_walls(StructuredShape& structured);

}  // namespace stackabilization::detail
