#include "structure/fitting/curve_skeleton.h"

#include <CGAL/memory.h>

#include "structure/fitting/creation_order_allocator.h"

// The skeletonization collapses edges of a Polyhedron_3 in the order of their addresses. Only the default of
// that class template takes the allocator named here.
#undef CGAL_ALLOCATOR
#define CGAL_ALLOCATOR(T) stackabilization::detail::CreationOrderAllocator<T>
#include <CGAL/Polyhedron_3_fwd.h>
#undef CGAL_ALLOCATOR
#define CGAL_ALLOCATOR(T) std::allocator<T>

#include <CGAL/Simple_cartesian.h>
#include <CGAL/Surface_mesh.h>
#include <CGAL/extract_mean_curvature_flow_skeleton.h>

#include <cstddef>
#include <exception>

namespace stackabilization::detail {

namespace {

using Kernel = CGAL::Simple_cartesian<double>;
using Mesh = CGAL::Surface_mesh<Kernel::Point_3>;
/// Several times the memory for the skeleton of a few thousand triangles. Unused memory costs nothing.
constexpr std::size_t memory = std::size_t{1} << 27;

using Skeletonization = CGAL::Mean_curvature_flow_skeletonization<Mesh>;

Mesh to_mesh(const Shape& shape) {
  Mesh mesh;
  for (const auto& p : shape.vertices.rowwise()) mesh.add_vertex({p.x(), p.y(), p.z()});
  const auto vertex = [](std::int32_t v) { return Mesh::Vertex_index(static_cast<Mesh::size_type>(v)); };
  for (const auto& t : shape.triangles.rowwise()) mesh.add_face(vertex(t(0)), vertex(t(1)), vertex(t(2)));
  return mesh;
}

}  // namespace

std::optional<Skeleton> curve_skeleton(const Shape& closed_surface) {
  const CreationOrderMemory creation_order(memory);
  Skeletonization::Skeleton graph;
  try {
    CGAL::extract_mean_curvature_flow_skeleton(to_mesh(closed_surface), graph);
  } catch (const std::exception&) {
    return std::nullopt;
  }
  Skeleton skeleton;
  skeleton.points.resize(static_cast<Eigen::Index>(num_vertices(graph)), 3);
  for (const auto v : CGAL::make_range(vertices(graph))) {
    const Kernel::Point_3& p = graph[v].point;
    skeleton.points.row(static_cast<Eigen::Index>(v)) << p.x(), p.y(), p.z();
  }
  for (const auto e : CGAL::make_range(edges(graph)))
    skeleton.edges.push_back({static_cast<int>(source(e, graph)), static_cast<int>(target(e, graph))});
  if (skeleton.edges.empty() || !skeleton.points.allFinite()) return std::nullopt;
  return skeleton;
}

}  // namespace stackabilization::detail
