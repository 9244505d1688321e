#pragma once

#include <vector>

#include "structure/segmentation/chords.h"

namespace stackabilization::detail {

/// Computes the empty volume of the best primitive around a piece of surface and the solid behind it: the
/// integral over the surface of the squared length of the chords inside the primitive but outside the solid.
/// The unit is area times length squared. The primitives are a cuboid, a ring, and a solid of revolution
/// whose squared radius is a quadratic function along the axis (cylinder, cone, spheroid, paraboloid). The
/// primitive touches the piece from outside. Cavities that the shape itself encloses count as filled, so that
/// a vessel fits as well as a solid.
///
/// `chord`: rows of the chords of the piece.
double volume_error(const std::vector<Chord>& chords, const std::vector<std::int32_t>& chord);

}  // namespace stackabilization::detail
