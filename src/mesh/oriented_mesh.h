#pragma once

#include <cstdint>
#include <vector>

#include "mesh/welded_mesh.h"
#include "stackabilization/core/shape.h"

namespace stackabilization::detail {

/// A mesh whose neighbouring triangles agree about the side that is outside, with at most two triangles to an
/// edge.
struct OrientedMesh {
  Points points;                     ///< model units; those of the welded mesh first, then repetitions
  Triangles triangles;               ///< rows of `points`
  std::vector<std::int32_t> source;  ///< per triangle its row in the shape, ascending
};

/// Turns triangles so that neighbours agree, and cuts the surface by repeating vertices where it is no
/// manifold: at edges of three and more triangles, vertices of several fans, and Moebius bands. Triangles
/// with two equal corners are left out. Deterministic.
OrientedMesh orient(const WeldedMesh& mesh);

}  // namespace stackabilization::detail
