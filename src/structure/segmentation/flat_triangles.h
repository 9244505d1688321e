#pragma once

#include "stackabilization/core/shape.h"

namespace stackabilization::detail {

/// Gives triangles that are flat to a line (tolerance::flat_triangle) to the part of the surface beside their
/// longest edge. Files hold such triangles where corners within an edge were connected to it, with labels of
/// either side: one that runs down along a leg would take the top that it is labelled with to the floor.
/// Those with a neighbour of their own part there stay, and so do parts of nothing else.
Shape with_flat_triangles_at_their_edges(const Shape& shape);

}  // namespace stackabilization::detail
