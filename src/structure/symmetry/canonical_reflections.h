#pragma once

#include <vector>

#include "structure/symmetry/symmetry_surface.h"

namespace stackabilization::detail {

/// The mutually orthogonal reflections, three at most, that stand for the symmetry of a design: chosen from
/// `candidates` (model units) in the order of how much of the shape lines up with them, by the boxes of its
/// parts and of the whole, and made exactly orthogonal. A square table is meant to be symmetric about the
/// planes along its sides, not the diagonals. `parts` may hold fewer entries than the shape has parts.
std::vector<Symmetry> canonical_reflections(const SymmetrySurface& whole,
                                            const std::vector<const SymmetrySurface*>& parts,
                                            const std::vector<Symmetry>& candidates);

/// Two perpendicular planes through the axis of a revolution. As any would do, they follow the axes of the
/// file.
std::vector<Symmetry> planes_through(const Symmetry& axis);

/// `plane` turned and moved by the little that makes it generate a finite group with the orthogonal planes
/// `chosen`: to a right angle or a multiple of pi / n with each, and through the line that two of them have
/// in common.
Symmetry fitted_to(const std::vector<Symmetry>& chosen, const Symmetry& plane);

}  // namespace stackabilization::detail
