#pragma once

#include "stackabilization/mesh/boxes.h"
#include "stackabilization/structure/primitive.h"

namespace stackabilization {

/// The box nearest to a cuboid: same centre, the mean directions of its edges made perpendicular (polar
/// decomposition), their mean lengths. Its axes are those of the cuboid in their order, left-handed for a
/// mirrored one, so that `cuboid_of` gives the corners in the cuboid's order. Exact up to rounding for a
/// cuboid that is a box; commutes with isometries and relabellings of the corners. Flat cuboids are accepted.
OrientedBox nearest_box(const Cuboid& cuboid);

/// Whether every corner lies within tolerance::relative of the cuboid's size from that of its nearest box.
bool is_box(const Cuboid& cuboid);

}  // namespace stackabilization
