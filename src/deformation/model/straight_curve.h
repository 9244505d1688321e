#pragma once

#include <Eigen/Core>

#include "stackabilization/structure/primitive.h"

namespace stackabilization::detail {

/// Returns the vector from the first to the last centre of a generalized cylinder, model units.
Eigen::Vector3d chord_of(const GeneralizedCylinder& cylinder);

/// Returns the n positions of the sections along the chord, model units, 0 at the first section.
Eigen::VectorXd places_along_chord(const GeneralizedCylinder& cylinder);

/// Returns whether the curve of an open generalized cylinder stays within 2 % of its chord length of its
/// chord.
bool is_straight(const GeneralizedCylinder& cylinder);

/// Returns whether, in addition, its radii stay within 2 % of the chord length of those of a cylinder or cone
/// through its first and last section.
bool has_straight_wall(const GeneralizedCylinder& cylinder);

}  // namespace stackabilization::detail
