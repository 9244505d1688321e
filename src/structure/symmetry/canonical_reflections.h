#pragma once

#include <vector>

#include "structure/symmetry/symmetry_surface.h"

namespace stackabilization::detail {

/// Selects at most three mutually orthogonal reflections that represent the symmetry of a design, and makes
/// them exactly orthogonal. `candidates` are in model units. A candidate has priority by the share of the
/// shape that is aligned with it; the boxes of the parts and of the whole shape measure this. A square table,
/// for example, gets the planes along its sides, not the diagonals. `parts` may have fewer entries than the
/// shape has parts.
std::vector<Symmetry> canonical_reflections(const SymmetrySurface& whole,
                                            const std::vector<const SymmetrySurface*>& parts,
                                            const std::vector<Symmetry>& candidates);

/// Returns two perpendicular planes through the axis of a revolution. All such planes are equivalent; these
/// follow the axes of the file.
std::vector<Symmetry> planes_through(const Symmetry& axis);

/// Returns `plane` after the smallest rotation and translation by which it generates a finite group with the
/// orthogonal planes `chosen`. It meets each of them at a right angle or at a multiple of pi / n, and
/// contains the common line of two of them.
Symmetry fitted_to(const std::vector<Symmetry>& chosen, const Symmetry& plane);

}  // namespace stackabilization::detail
