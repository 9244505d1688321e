#pragma once

#include "stackabilization/structure/primitive.h"

namespace stackabilization::detail {

/// Which pair of opposite faces the axis of a cuboid runs between, 0 to 2: the pair that is farthest apart,
/// the first of those that are equally far to tolerance::relative. 0 for generalized cylinders.
int axis_of(const Primitive& primitive);

/// Corners of the axis of a primitive, at least two: the curve of a generalized cylinder (a closed one ends
/// where it began), or the centres of two opposite faces of a cuboid.
Points axis_curve(const Primitive& primitive, int axis);

/// Least distance between two polygonal curves of at least one segment each, model units.
double curve_distance(const Points& a, const Points& b);

}  // namespace stackabilization::detail
