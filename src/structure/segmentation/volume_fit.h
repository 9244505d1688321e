#pragma once

#include <vector>

#include "structure/segmentation/chords.h"

/// Not installed.
namespace stackabilization::detail {

/// How badly a piece of surface and the solid behind it fill the best of a cuboid, a solid of revolution
/// whose squared radius is a quadratic function along its axis (cylinder, cone, spheroid, paraboloid), and a
/// ring: integral over the surface of the squared length of the empty stretches of the chords inside the
/// primitive, which touches the piece from outside. Hollows closed in by the shape itself count as full, so
/// that a vessel is as good as a solid.
///
/// Units: area times length squared. `chord` says which chords make up the piece.
double volume_error(const std::vector<Chord>& chords, const std::vector<std::int32_t>& chord);

}  // namespace stackabilization::detail
