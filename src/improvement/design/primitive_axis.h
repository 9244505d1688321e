#pragma once

#include "stackabilization/structure/primitive.h"

namespace stackabilization::detail {

/// Returns the pair of opposite faces between which the axis of a cuboid runs, 0 to 2: the pair that is
/// farthest apart (ties within tolerance::relative: the first pair). 0 for generalized cylinders.
int axis_of(const Primitive& primitive);

/// Returns the axis of a primitive as a polyline of at least two points: the curve of a generalized cylinder
/// (a closed one ends at its first point), or the segment between the centres of the two faces `axis` of a
/// cuboid.
Points axis_curve(const Primitive& primitive, int axis);

/// Returns the least distance between two polylines of at least one segment each, model units.
double curve_distance(const Points& a, const Points& b);

}  // namespace stackabilization::detail
