#include "structure/fitting/closed_part.h"

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Polygon_mesh_processing/border.h>
#include <CGAL/Polygon_mesh_processing/connected_components.h>
#include <CGAL/Polygon_mesh_processing/measure.h>
#include <CGAL/Polygon_mesh_processing/orient_polygon_soup.h>
#include <CGAL/Polygon_mesh_processing/orientation.h>
#include <CGAL/Polygon_mesh_processing/polygon_soup_to_polygon_mesh.h>
#include <CGAL/Polygon_mesh_processing/remesh.h>
#include <CGAL/Surface_mesh.h>
#include <CGAL/alpha_wrap_3.h>
#include <CGAL/boost/graph/iterator.h>

#include <array>
#include <cmath>
#include <cstddef>
#include <exception>
#include <iterator>
#include <vector>

#include "mesh/principal_extents.h"
#include "mesh/welded_mesh.h"
#include "stackabilization/core/tolerances.h"

namespace stackabilization::detail {

namespace {

namespace PMP = CGAL::Polygon_mesh_processing;
using Epick = CGAL::Exact_predicates_inexact_constructions_kernel;
using PartMesh = CGAL::Surface_mesh<Epick::Point_3>;

/// Triangles that a skeleton is made from: enough for a dozen around a slender bar.
constexpr double wanted_triangles = 2000;
/// Above this a part is clustered and wrapped.
constexpr std::size_t max_triangles = 20000;
/// Cells along the diagonal of a clustered part.
constexpr double clusters = 150;
/// Alpha wrap: ratio of the diagonal to alpha, and to the offset.
constexpr double wrap_alpha = 24, wrap_offset = 120;

/// Least area of a surface whose mouths get caps, fraction of the sum of their squared lengths.
constexpr double min_area_at_mouths = 0.25;

struct Soup {
  std::vector<Epick::Point_3> points;
  std::vector<std::array<std::size_t, 3>> polygons;
};

/// Returns the welded triangles of a part. With a positive `cell`, all vertices in a grid cell of that size
/// become the first one of the cell.
Soup soup_of(const Shape& part, double cell) {
  Shape cells = part;
  if (cell > 0) cells.vertices = (part.vertices / cell).array().floor();
  const WeldedMesh mesh = weld(cells);
  Soup soup;
  for (const std::int32_t v : mesh.first_vertex)
    soup.points.emplace_back(part.vertices(v, 0), part.vertices(v, 1), part.vertices(v, 2));
  for (Eigen::Index t = 0; t < mesh.triangles.rows(); ++t) {
    if (mesh.has_equal_corners(t)) continue;
    const Eigen::Matrix<std::size_t, 1, 3> corner = mesh.triangles.row(t).cast<std::size_t>();
    soup.polygons.push_back({corner(0), corner(1), corner(2)});
  }
  return soup;
}

/// The soup as a closed, connected surface; empty when it is none.
PartMesh as_closed(Soup soup) {
  PartMesh mesh;
  if (!PMP::orient_polygon_soup(soup.points, soup.polygons)) return mesh;
  PMP::polygon_soup_to_polygon_mesh(soup.points, soup.polygons, mesh);
  auto component = mesh.add_property_map<PartMesh::Face_index, std::size_t>("f:component").first;
  if (!CGAL::is_closed(mesh) || PMP::connected_components(mesh, component) != 1) return {};
  if (!PMP::is_outward_oriented(mesh)) PMP::reverse_face_orientations(mesh);
  return mesh;
}

/// Adds fans around the centres of the mouths of a surface where they are narrow for its area. An alpha wrap
/// would line a tube with open ends inside.
void cap_narrow_mouths(Soup& soup) {
  Soup oriented = soup;
  if (!PMP::orient_polygon_soup(oriented.points, oriented.polygons)) return;
  PartMesh mesh;
  PMP::polygon_soup_to_polygon_mesh(oriented.points, oriented.polygons, mesh);
  std::vector<PartMesh::Halfedge_index> mouths;
  PMP::extract_boundary_cycles(mesh, std::back_inserter(mouths));
  double squares = 0;
  Soup fans;
  for (const auto mouth : mouths) {
    Epick::Vector_3 moment = CGAL::NULL_VECTOR;
    double length = 0;
    const std::size_t first = fans.points.size();
    for (const auto h : CGAL::halfedges_around_face(mouth, mesh)) {
      const Epick::Point_3 &a = mesh.point(mesh.source(h)), &b = mesh.point(mesh.target(h));
      const double edge = std::sqrt(CGAL::squared_distance(a, b));
      moment += edge * (CGAL::midpoint(a, b) - CGAL::ORIGIN);
      length += edge;
      fans.points.push_back(a);
    }
    squares += length * length;
    const std::size_t centre = fans.points.size();
    for (std::size_t k = first; k < centre; ++k)
      fans.polygons.push_back({k, k + 1 < centre ? k + 1 : first, centre});
    fans.points.push_back(length > 0 ? CGAL::ORIGIN + moment / length : fans.points[first]);
  }
  if (!(PMP::area(mesh) >= min_area_at_mouths * squares)) return;
  const std::size_t count = soup.points.size();
  soup.points.insert(soup.points.end(), fans.points.begin(), fans.points.end());
  for (const auto& [a, b, c] : fans.polygons) soup.polygons.push_back({count + a, count + b, count + c});
}

void remesh(PartMesh& mesh) {
  const double area = PMP::area(mesh);
  const double edge = std::sqrt(area / wanted_triangles * 4 / std::sqrt(3.0));
  PMP::isotropic_remeshing(mesh.faces(), edge, mesh, CGAL::parameters::number_of_iterations(2));
  mesh.collect_garbage();
}

Shape to_shape(const PartMesh& mesh) {
  Points points(static_cast<Eigen::Index>(mesh.number_of_vertices()), 3);
  for (const auto v : mesh.vertices()) {
    const Epick::Point_3& p = mesh.point(v);
    points.row(static_cast<Eigen::Index>(v)) << p.x(), p.y(), p.z();
  }
  Triangles triangles(static_cast<Eigen::Index>(mesh.number_of_faces()), 3);
  for (const auto f : mesh.faces()) {
    int k = 0;
    for (const auto v : mesh.vertices_around_face(mesh.halfedge(f)))
      triangles(static_cast<Eigen::Index>(f), k++) = static_cast<std::int32_t>(v);
  }
  return make_shape(std::move(points), std::move(triangles));
}

}  // namespace

std::optional<ClosedPart> closed_part(const Shape& part) {
  try {
    const auto count = static_cast<std::size_t>(part.triangle_count());
    const double diagonal = Eigen::Vector3d(range_along(part, Eigen::Vector3d::UnitX()).length(),
                                            range_along(part, Eigen::Vector3d::UnitY()).length(),
                                            range_along(part, Eigen::Vector3d::UnitZ()).length())
                                .norm();
    // Remeshing collapses such a plate through itself, with or without a wrap, and CGAL 5.5 may crash on the
    // result.
    if (principal_extents(part.vertices, tolerance::relative * diagonal).length(2) < diagonal / wrap_offset)
      return std::nullopt;
    Soup soup = soup_of(part, count > max_triangles ? diagonal / clusters : 0);
    PartMesh mesh;
    if (count <= max_triangles) mesh = as_closed(soup);
    const bool wrapped = mesh.is_empty();
    if (wrapped) {
      cap_narrow_mouths(soup);
      CGAL::alpha_wrap_3(soup.points, soup.polygons, diagonal / wrap_alpha, diagonal / wrap_offset, mesh);
    }
    remesh(mesh);
    if (mesh.is_empty() || !CGAL::is_closed(mesh)) return std::nullopt;
    return ClosedPart{to_shape(mesh), wrapped};
  } catch (const std::exception&) {
    return std::nullopt;
  }
}

}  // namespace stackabilization::detail
