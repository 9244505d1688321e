#include "stackabilization/shape/convex_hull.h"

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Surface_mesh.h>
#include <CGAL/convex_hull_3.h>

#include <algorithm>
#include <array>
#include <vector>

namespace stackabilization {

namespace {

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using Mesh = CGAL::Surface_mesh<Kernel::Point_3>;

/// Vertices of the mesh in lexicographic order of their coordinates.
std::vector<Mesh::Vertex_index> sorted_vertices(const Mesh& mesh) {
  std::vector<Mesh::Vertex_index> vertices(mesh.vertices().begin(), mesh.vertices().end());
  std::sort(vertices.begin(), vertices.end(), [&](auto a, auto b) { return mesh.point(a) < mesh.point(b); });
  return vertices;
}

}  // namespace

TriangulatedHull triangulated_hull(const Points& points) {
  std::vector<Kernel::Point_3> input;
  input.reserve(static_cast<std::size_t>(points.rows()));
  for (Eigen::Index i = 0; i < points.rows(); ++i)
    input.emplace_back(points(i, 0), points(i, 1), points(i, 2));
  Mesh mesh;
  CGAL::convex_hull_3(input.begin(), input.end(), mesh);

  TriangulatedHull hull;
  const std::vector<Mesh::Vertex_index> vertices = sorted_vertices(mesh);
  std::vector<std::int32_t> row(mesh.number_of_vertices());
  hull.points.resize(static_cast<Eigen::Index>(vertices.size()), 3);
  for (std::size_t i = 0; i < vertices.size(); ++i) {
    const Kernel::Point_3& p = mesh.point(vertices[i]);
    hull.points.row(static_cast<Eigen::Index>(i)) << p.x(), p.y(), p.z();
    row[vertices[i]] = static_cast<std::int32_t>(i);
  }
  // Quickhull keeps its facets in the order of their addresses, which is not the same in every run.
  std::vector<std::array<std::int32_t, 3>> triangles;
  for (const Mesh::Face_index face : mesh.faces()) {
    std::array<std::int32_t, 3> triangle;
    int corner = 0;
    for (const Mesh::Vertex_index v : CGAL::vertices_around_face(mesh.halfedge(face), mesh))
      triangle[static_cast<std::size_t>(corner++)] = row[v];
    std::rotate(triangle.begin(), std::min_element(triangle.begin(), triangle.end()), triangle.end());
    triangles.push_back(triangle);
  }
  std::sort(triangles.begin(), triangles.end());
  hull.triangles.resize(static_cast<Eigen::Index>(triangles.size()), 3);
  for (std::size_t t = 0; t < triangles.size(); ++t)
    hull.triangles.row(static_cast<Eigen::Index>(t)) << triangles[t][0], triangles[t][1], triangles[t][2];
  return hull;
}

}  // namespace stackabilization
