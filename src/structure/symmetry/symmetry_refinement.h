#pragma once

#include "structure/symmetry/symmetry_surface.h"

namespace stackabilization::detail {

/// Largest error of a candidate from voting, own frame.
constexpr double rough_reach = 0.1;

/// Refines `start` (own frame) by Gauss-Newton steps on the distances from the images of samples and vertices
/// to the surface, with Geman-McClure weights. Distances beyond about `reach` (own frame) have little
/// influence; below tolerance::relative, that is the reach. A rotation keeps its angle. A revolution is
/// treated as the half turn.
Symmetry step_symmetry(const SymmetrySurface& surface, const Symmetry& start, double reach, Effort effort);

/// Refines `start` with all points and a decreasing reach (graduated non-convexity). The reach decreases as
/// long as half of the information about every degree of freedom remains. Where the surface is symmetric
/// except for some detail, the result is exact up to rounding. Where the surface is noisy, it is a robust
/// mean.
Symmetry refine_symmetry(const SymmetrySurface& surface, const Symmetry& start, double reach);

}  // namespace stackabilization::detail
