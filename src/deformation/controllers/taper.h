#pragma once

#include <vector>

#include "deformation/controllers/part_edit.h"
#include "stackabilization/structure/structure.h"

namespace stackabilization::detail {

/// Computes the prescriptions of a taper on all parts as wholes, one per part in order: see Taper. The
/// heights of the ends of the shape are those of its control points. The centre is the middle of their
/// widths, on the mirror planes and rotation axes along the taper of the whole shape, then of its parts,
/// widest first.
std::vector<PartEdit> tapered(const std::vector<Primitive>& now, const Taper& taper, const Structure& rest);

}  // namespace stackabilization::detail
