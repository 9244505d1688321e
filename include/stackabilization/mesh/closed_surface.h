#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "stackabilization/core/shape.h"

namespace stackabilization {

/// How the triangles of a shape hang together along their edges, when they close up.
struct ClosedSurface {
  /// Is every edge run through exactly once in each direction? The rest is empty unless it is.
  bool closed = false;
  /// Per triangle and corner k, the corner of the neighbour across the edge (k, k + 1) that lies opposite to
  /// that edge, as a row of the vertex matrix.
  std::vector<std::array<std::int32_t, 3>> opposite;
  /// Connected component of every triangle: an index into `representatives`; -1 for triangles with two equal
  /// corners.
  std::vector<std::int32_t> component;
  /// The first triangle of every component, ascending.
  std::vector<std::int32_t> representatives;
};

/// Looks for a closed surface in the shape's indices; where they do not close up, in corners of equal
/// coordinates; then in such corners part by part (parts that touch along an edge). Triangles with two equal
/// corners are passed over.
ClosedSurface closed_surface(const Shape& shape);

}  // namespace stackabilization
