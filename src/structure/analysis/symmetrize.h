#pragma once

#include <optional>

#include "stackabilization/structure/structure.h"
#include "structure/model/symmetry_orbit.h"

namespace stackabilization::detail {

/// Symmetrizes the primitives as `symmetrize` does, but returns a contradiction instead of throwing.
/// `structure` is then only partly changed. The last of the contradicting relations is the one to remove.
std::optional<Contradiction> try_symmetrize(Structure& structure);

/// Replaces the primitives of an orbit by their symmetric mean. The mean is taken over all parts, mapped to
/// each part by the symmetries, and over the group of the orbit.
void make_symmetric(Structure& structure, const Orbit& orbit);

/// Computes the residual of a symmetry relation, model units: the largest distance between the image of a
/// control point and its counterpart, and the largest difference of corresponding radii. Infinite when the
/// primitives do not correspond. Precondition: `relation` is a symmetry or a self-symmetry.
double symmetry_residual(const Structure& structure, const Relation& relation);

}  // namespace stackabilization::detail
