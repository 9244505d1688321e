#pragma once

#include <optional>

#include "stackabilization/structure/structure.h"
#include "structure/model/symmetry_orbit.h"

namespace stackabilization::detail {

/// What `symmetrize` does, telling what contradicts instead of throwing; `structure` is then half done. The
/// last of the contradicting relations is the one to do without.
std::optional<Contradiction> try_symmetrize(Structure& structure);

/// Gives the parts of an orbit the mean of their primitives, seen from each of them, averaged over the group
/// of the orbit.
void make_symmetric(Structure& structure, const Orbit& orbit);

/// Largest distance between where `relation`, a symmetry, takes the control points of its part and where they
/// should go, radii compared likewise, model units. Infinite when the primitives do not correspond.
double symmetry_residual(const Structure& structure, const Relation& relation);

}  // namespace stackabilization::detail
