#pragma once

#include "stackabilization/mesh/boxes.h"
#include "stackabilization/structure/primitive.h"

namespace stackabilization {

/// Computes the box nearest to a cuboid. It has the centre of the cuboid, the mean directions of its edges,
/// made orthogonal by polar decomposition, and their mean lengths. The axes are in the order of the cuboid,
/// and left-handed for a mirrored cuboid, so that `cuboid_of` returns the corners in the order of the cuboid.
/// Exact up to rounding for a cuboid that is a box. Commutes with isometries and relabellings of the corners.
/// Accepts flat cuboids.
OrientedBox nearest_box(const Cuboid& cuboid);

/// Returns whether every corner lies within tolerance::relative of the size of the cuboid from the
/// corresponding corner of its nearest box.
bool is_box(const Cuboid& cuboid);

}  // namespace stackabilization
