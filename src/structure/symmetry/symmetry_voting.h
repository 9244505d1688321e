#pragma once

#include <vector>

#include "stackabilization/structure/symmetry_detection.h"
#include "structure/symmetry/symmetry_surface.h"

namespace stackabilization::detail {

/// Reflections (own frame) that many pairs of surface samples vote for, most votes first (Mitra, Guibas and
/// Pauly 2006). Furniture is flat, so instead of curvatures a pair must agree in how much of the surface lies
/// within several distances of each sample, which any symmetry keeps. Votes are counted on a grid over the
/// planes, peaks moved to the mean of the votes around. Planes far from the centroid of the area are left
/// out: missing detail can move it only a little.
std::vector<Symmetry> voted_reflections(const SymmetrySurface& surface, const SymmetryOptions& options);

/// Axes (own frame, `order` without meaning) through the centroid that many pairs of samples with their
/// normals vote for: each pair fixes a rotation about the centroid.
std::vector<Symmetry> voted_axes(const SymmetrySurface& surface);

}  // namespace stackabilization::detail
