#pragma once

#include "structure/symmetry/symmetry_surface.h"

namespace stackabilization::detail {

/// How far candidates that are voted for may be off, own frame.
constexpr double rough_reach = 0.1;

/// The symmetry near `start` (own frame) that fits the surface best as far as distances up to about `reach`
/// (own frame) go: Gauss-Newton steps on the distances from images of samples and vertices to the surface
/// with Geman-McClure weights. Rotations keep their angle, revolutions are treated as the half turn.
Symmetry step_symmetry(const SymmetrySurface& surface, const Symmetry& start, double reach, Effort effort);

/// The same with all points and a reach that shrinks for as long as half of the knowledge about every freedom
/// remains (graduated non-convexity). Where the surface is symmetric but for some detail, the result is exact
/// up to rounding; where it is noisy, a robust mean.
Symmetry refine_symmetry(const SymmetrySurface& surface, const Symmetry& start, double reach);

}  // namespace stackabilization::detail
