#include <OpenMesh/Core/Mesh/TriMesh_ArrayKernelT.hh>
#include <map>

#include "mesh/edge_table.h"
#include "support/catch.h"
#include "support/solids.h"

using namespace stackabilization;
using detail::EdgeTable;
using detail::TriangleSide;

namespace {

using HalfEdges = OpenMesh::TriMesh_ArrayKernelT<>;

HalfEdges half_edges_of(const Shape& shape) {
  HalfEdges mesh;
  for (Eigen::Index v = 0; v < shape.vertex_count(); ++v) mesh.add_vertex({0, 0, 0});
  for (const auto t : shape.triangles.rowwise())
    mesh.add_face(HalfEdges::VertexHandle(t(0)), HalfEdges::VertexHandle(t(1)),
                  HalfEdges::VertexHandle(t(2)));
  return mesh;
}

/// Vertices of an edge, and the faces beside it.
using Neighbours = std::map<std::pair<int, int>, std::vector<int>>;

Neighbours neighbours(const EdgeTable& edges) {
  Neighbours found;
  for (std::size_t e = 0; e < edges.size(); ++e)
    for (const TriangleSide& side : edges[e]) found[{side.low, side.high}].push_back(side.triangle);
  return found;
}

Neighbours neighbours(const HalfEdges& mesh) {
  Neighbours found;
  for (const auto edge : mesh.edges()) {
    const int a = edge.v0().idx(), b = edge.v1().idx();
    std::vector<int>& faces = found[std::minmax(a, b)];
    for (const auto half : {edge.h0(), edge.h1()})
      if (!half.is_boundary()) faces.push_back(half.face().idx());
    std::sort(faces.begin(), faces.end());
  }
  return found;
}

Shape without_first(Shape shape, Eigen::Index count) {
  shape.triangles = shape.triangles.bottomRows(shape.triangle_count() - count).eval();
  shape.triangle_part.resize(static_cast<std::size_t>(shape.triangle_count()));
  return shape;
}

}  // namespace

TEST_CASE("edges of manifolds have the neighbours that half-edges give them") {
  for (const Shape& shape :
       {solids::box({1, 2, 3}), solids::cylinder(1, 2, 30), without_first(solids::cylinder(1, 2, 30), 7),
        without_first(solids::box({1, 1, 1}), 1)}) {
    const EdgeTable edges(shape.triangles);
    const HalfEdges mesh = half_edges_of(shape);
    REQUIRE(mesh.n_faces() == static_cast<std::size_t>(shape.triangle_count()));
    CHECK(edges.size() == mesh.n_edges());
    CHECK(neighbours(edges) == neighbours(mesh));
  }
}

TEST_CASE("sides of one edge are ordered by triangle and know their ends") {
  Triangles fins(4, 3);  // three sheets at the edge (0, 1), one of them turned around, and one twice
  fins << 0, 1, 2, 1, 0, 3, 0, 1, 4, 0, 1, 4;
  const EdgeTable edges(fins);
  REQUIRE(edges.size() == 7);
  REQUIRE(edges[0].size() == 4);
  for (std::int32_t t = 0; t < 4; ++t) {
    const TriangleSide& side = edges[0][static_cast<std::size_t>(t)];
    CHECK(side.triangle == t);
    CHECK(side.forward == (t != 1));
    CHECK(fins(t, side.corner) == (side.forward ? side.low : side.high));
  }
  CHECK(edges.sides().size() == 12);
}

TEST_CASE("triangles with a vertex twice have no sides, or those whose ends differ") {
  Triangles triangles(2, 3);
  triangles << 0, 0, 1, 2, 2, 2;
  CHECK(EdgeTable(triangles).size() == 0);
  const EdgeTable kept(triangles, EdgeTable::Collapsed::keep);
  REQUIRE(kept.size() == 1);
  REQUIRE(kept[0].size() == 2);
  CHECK(kept[0][0].forward != kept[0][1].forward);
  CHECK(EdgeTable(Triangles(0, 3)).size() == 0);
}
