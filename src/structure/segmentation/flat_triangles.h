#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "mesh/edge_table.h"
#include "mesh/welded_mesh.h"
#include "stackabilization/core/shape.h"

namespace stackabilization::detail {

/// A triangle that is flat to a line: its height is at most tolerance::flat_triangle of the diagonal of the
/// bounding box of the mesh. The rounded coordinates of a file then decide its normal.
struct FlatTriangle {
  std::int32_t row;  ///< row of the triangle matrix
  double length;     ///< length of the longest edge, model units
  std::size_t edge;  ///< row of the longest edge in the edge table
};

/// Returns the flat triangles with an edge in the table, longest first.
std::vector<FlatTriangle> flat_triangles(const WeldedMesh& mesh, const EdgeTable& edges);

/// Gives flat triangles to the part of the surface beside their
/// longest edge. Files hold such triangles where corners within an edge were connected to it, with labels of
/// either side: one that runs down along a leg would take the top that it is labelled with to the floor.
/// Those with a neighbour of their own part there stay, and so do parts of nothing else.
Shape with_flat_triangles_at_their_edges(const Shape& shape);

}  // namespace stackabilization::detail
