#pragma once

#include <OpenMesh/Core/Mesh/Traits.hh>
#include <OpenMesh/Core/Mesh/TriMesh_ArrayKernelT.hh>
#include <cstdint>
#include <vector>

#include "stackabilization/core/shape.h"

/// Not installed: shows OpenMesh.
namespace stackabilization::detail {

struct HalfEdgeTraits : OpenMesh::DefaultTraits {
  using Point = OpenMesh::Vec3d;
  using Normal = OpenMesh::Vec3d;
};
using HalfEdgeMesh = OpenMesh::TriMesh_ArrayKernelT<HalfEdgeTraits>;

/// A half-edge mesh over the triangles of a shape: what needs connectivity works on this and reports back by
/// triangle. Face f of `mesh` is triangle f of the shape, no triangle left out except `degenerate` ones,
/// which have fewer than three different corners and no face.
struct ConnectedSurface {
  HalfEdgeMesh mesh;
  std::vector<std::int32_t> triangle_of_face;
  std::vector<std::int32_t> vertex_of;   ///< per mesh vertex a row of Shape::vertices with its coordinates
  std::vector<std::int32_t> degenerate;  ///< triangles without a face
  std::int64_t cut_edges = 0;            ///< edges of three and more triangles, cut apart
};

/// Vertices of equal coordinates become one, triangles are turned so that neighbours agree, and where the
/// surface is not manifold (edges of three and more triangles, vertices of several fans, Moebius bands) it is
/// cut by repeating vertices. Deterministic. Precondition: `validate(shape)`.
ConnectedSurface connected_surface(const Shape& shape);

}  // namespace stackabilization::detail
