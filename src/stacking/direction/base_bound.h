#pragma once

#include "stackabilization/core/direction.h"
#include "stackabilization/mesh/boxes.h"

namespace stackabilization::detail {

/// Returns a lower bound of HullSupport::minimal_rectangle_area over all directions within `angle` of a
/// direction, model units squared; not negative. It approaches the area along the direction as the angle
/// approaches 0. `angle`: radians, in [0, pi/2].
///
/// The points p and q that are outermost along a unit vector e across r bound the width along every vector
/// e': at least (p - q).e'. When r turns by an angle t, e' loses at most sin t of p - q along r and 1 - cos t
/// of it across. The bound is the smallest product of two such widths over the intervals of turns about r in
/// which the outermost points stay the same; within an interval the product of the widths along r itself is
/// least at an end (Freeman and Shapira 1975).
double min_base(const HullSupport& hull, const Direction& direction, double angle);

}  // namespace stackabilization::detail
