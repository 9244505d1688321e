#include "mesh/half_edge_mesh.h"

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Polygon_mesh_processing/orient_polygon_soup.h>
#include <CGAL/Polygon_mesh_processing/orient_polygon_soup_extension.h>

#include <algorithm>
#include <array>
#include <map>
#include <utility>

#include "mesh/point_index.h"

namespace stackabilization::detail {

namespace {

using Point = CGAL::Exact_predicates_inexact_constructions_kernel::Point_3;
using Polygon = std::array<std::size_t, 3>;

/// The shape with one vertex per place, its first row remembered.
struct Soup {
  std::vector<Point> points;
  std::vector<Polygon> polygons;
};

std::int64_t edges_of_many(const std::vector<Polygon>& polygons) {
  std::map<std::pair<std::size_t, std::size_t>, int> uses;
  for (const Polygon& polygon : polygons)
    for (std::size_t k = 0; k < 3; ++k) ++uses[std::minmax(polygon[k], polygon[(k + 1) % 3])];
  return std::count_if(uses.begin(), uses.end(), [](const auto& edge) { return edge.second > 2; });
}

}  // namespace

ConnectedSurface connected_surface(const Shape& shape) {
  ConnectedSurface surface;
  PointIndex places;
  Soup soup;
  std::vector<std::int32_t> row_of_place;
  for (Eigen::Index t = 0; t < shape.triangle_count(); ++t) {
    Polygon polygon;
    for (int k = 0; k < 3; ++k) {
      const std::int32_t row = shape.triangles(t, k);
      const auto place = static_cast<std::size_t>(places.insert(shape.vertices.row(row).transpose()));
      if (place == row_of_place.size()) row_of_place.push_back(row);
      polygon[static_cast<std::size_t>(k)] = place;
    }
    if (polygon[0] == polygon[1] || polygon[1] == polygon[2] || polygon[2] == polygon[0]) {
      surface.degenerate.push_back(static_cast<std::int32_t>(t));
      continue;
    }
    soup.polygons.push_back(polygon);
    surface.triangle_of_face.push_back(static_cast<std::int32_t>(t));
  }
  for (const Eigen::Vector3d& p : places.points()) soup.points.emplace_back(p.x(), p.y(), p.z());
  surface.cut_edges = edges_of_many(soup.polygons);

  // CGAL appends copies of the points it repeats, and leaves the order of the polygons alone.
  const std::vector<Polygon> before = soup.polygons;
  CGAL::Polygon_mesh_processing::orient_polygon_soup(soup.points, soup.polygons);
  surface.vertex_of = row_of_place;
  surface.vertex_of.resize(soup.points.size(), -1);
  for (std::size_t f = 0; f < before.size(); ++f)
    for (std::size_t k = 0; k < 3; ++k) {
      // An orientation turned around keeps its first corner or swaps two; the copy is told by its
      // coordinates.
      const std::size_t vertex = soup.polygons[f][k];
      for (const std::size_t old : before[f])
        if (soup.points[vertex] == soup.points[old]) surface.vertex_of[vertex] = row_of_place[old];
    }

  for (const Point& p : soup.points) surface.mesh.add_vertex({p.x(), p.y(), p.z()});
  for (const Polygon& polygon : soup.polygons) {
    const auto handle = [](std::size_t v) { return HalfEdgeMesh::VertexHandle(static_cast<int>(v)); };
    surface.mesh.add_face(handle(polygon[0]), handle(polygon[1]), handle(polygon[2]));
  }
  return surface;
}

}  // namespace stackabilization::detail
