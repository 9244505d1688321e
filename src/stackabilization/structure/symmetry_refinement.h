#pragma once

#include "stackabilization/structure/symmetry_verification.h"

namespace stackabilization::detail {

/// The symmetry near `start` (own frame) that fits the surface best: Gauss-Newton steps on the distances from
/// images of samples and vertices to the surface, with Geman-McClure weights whose scale shrinks from `reach`
/// (own frame) for as long as half of the knowledge about every freedom remains (graduated non-convexity).
/// Where the surface is symmetric but for some detail, the result is exact up to rounding; where it is noisy,
/// a robust mean. Rotations keep their angle, revolutions are refined as the half turn.
Symmetry refined(const SymmetrySurface& surface, const Symmetry& start, double reach, Effort effort);

}  // namespace stackabilization::detail
