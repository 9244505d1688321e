#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "stackabilization/core/shape.h"

namespace stackabilization {

/// Edge adjacency of a closed surface.
struct ClosedSurface {
  /// Whether every edge is traversed exactly once in each direction. The other members are empty otherwise.
  bool closed = false;
  /// Per triangle and corner k, the corner opposite the edge (k, k + 1) in the neighbour across this edge, as
  /// a row of the vertex matrix.
  std::vector<std::array<std::int32_t, 3>> opposite;
  /// Connected component of every triangle, as an index of `representatives`; -1 for triangles with two equal
  /// corners.
  std::vector<std::int32_t> component;
  /// First triangle of every component, ascending.
  std::vector<std::int32_t> representatives;
};

/// Looks for a closed surface in three steps: by the vertex indices of the shape, then by equal coordinates,
/// then by equal coordinates within each part (for parts that touch along an edge). Triangles with two equal
/// corners are ignored.
ClosedSurface closed_surface(const Shape& shape);

}  // namespace stackabilization
