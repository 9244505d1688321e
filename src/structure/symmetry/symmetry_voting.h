#pragma once

#include <vector>

#include "stackabilization/structure/symmetry_detection.h"
#include "structure/symmetry/symmetry_surface.h"

namespace stackabilization::detail {

/// Returns the reflections (own frame) with many votes of pairs of surface samples, most votes first (Mitra,
/// Guibas and Pauly 2006). Furniture is flat, so the signature of a sample is not its curvature but the area
/// of the surface within several distances of it, which is invariant under symmetries. Votes are counted on a
/// grid over the planes. A peak moves to the mean of the votes around it. Planes far from the centroid of the
/// area are omitted: missing detail moves the centroid only a little.
std::vector<Symmetry> voted_reflections(const SymmetrySurface& surface, const SymmetryOptions& options);

/// Returns the axes (own frame, `order` without meaning) through the centroid with many votes of pairs of
/// samples and their normals. Each pair determines a rotation about the centroid.
std::vector<Symmetry> voted_axes(const SymmetrySurface& surface);

}  // namespace stackabilization::detail
