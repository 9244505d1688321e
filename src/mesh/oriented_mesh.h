#pragma once

#include <cstdint>
#include <vector>

#include "mesh/welded_mesh.h"
#include "stackabilization/core/shape.h"

namespace stackabilization::detail {

/// A consistently oriented mesh with at most two triangles per edge.
struct OrientedMesh {
  /// Model units; the points of the welded mesh, then repeated points.
  Points points;
  Triangles triangles;               ///< rows of `points`
  std::vector<std::int32_t> source;  ///< row of each triangle in the shape, ascending
};

/// Orients the triangles consistently and makes the surface manifold. The function cuts the surface, by
/// repeated vertices, at edges of three and more triangles, at vertices of several fans, and across Moebius
/// bands. It omits triangles with two equal corners. Deterministic.
OrientedMesh orient(const WeldedMesh& mesh);

}  // namespace stackabilization::detail
