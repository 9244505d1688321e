#include "stackabilization/mesh/convex_hull.h"

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Projection_traits_xy_3.h>
#include <CGAL/Projection_traits_xz_3.h>
#include <CGAL/Projection_traits_yz_3.h>
#include <CGAL/Surface_mesh.h>
#include <CGAL/convex_hull_2.h>
#include <CGAL/convex_hull_3.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <iterator>
#include <utility>
#include <vector>

#include "core/disjoint_sets.h"
#include "mesh/affine_span.h"

namespace stackabilization {

namespace {

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using Point = Kernel::Point_3;
using Mesh = CGAL::Surface_mesh<Point>;
using Vertex = Mesh::Vertex_index;

std::vector<Point> points_of(const Points& points) {
  std::vector<Point> result;
  result.reserve(static_cast<std::size_t>(points.rows()));
  for (Eigen::Index i = 0; i < points.rows(); ++i)
    result.emplace_back(points(i, 0) + 0.0, points(i, 1) + 0.0, points(i, 2) + 0.0);  // no negative zeros
  return result;
}

/// Precondition: the points do not lie in a plane.
Mesh quickhull(const std::vector<Point>& points) {
  Mesh mesh;
  CGAL::convex_hull_3(points.begin(), points.end(), mesh);
  return mesh;
}

/// Triangles in one plane with their neighbours, as one set: a facet.
DisjointSets facets_of(const Mesh& mesh) {
  DisjointSets facets(mesh.number_of_faces());
  for (const Mesh::Edge_index edge : mesh.edges()) {
    const Mesh::Halfedge_index one = mesh.halfedge(edge), other = mesh.opposite(one);
    if (CGAL::coplanar(mesh.point(mesh.source(one)), mesh.point(mesh.target(one)),
                       mesh.point(mesh.target(mesh.next(one))), mesh.point(mesh.target(mesh.next(other)))))
      facets.join(mesh.face(one), mesh.face(other));
  }
  return facets;
}

/// A side of the boundary of a facet, between two of its points, which need not be corners.
struct Side {
  std::size_t facet;
  Vertex from, to;

  auto key() const { return std::pair(facet, from.idx()); }
};

/// Returns the sides of all facets, those of one together, by their starts.
std::vector<Side> sides_of(const Mesh& mesh) {
  DisjointSets facets = facets_of(mesh);
  std::vector<Side> sides;
  for (const Mesh::Halfedge_index side : mesh.halfedges()) {
    const std::size_t facet = facets.root(mesh.face(side));
    if (facet != facets.root(mesh.face(mesh.opposite(side))))
      sides.push_back({facet, mesh.source(side), mesh.target(side)});
  }
  std::sort(sides.begin(), sides.end(), [](const Side& a, const Side& b) { return a.key() < b.key(); });
  return sides;
}

/// Polygons that make up a hull: rows of its corners, each with its smallest one first.
struct Polygons {
  std::vector<Point> corners;  ///< in lexicographic order
  std::vector<std::vector<std::int32_t>> rows;
};

void put_smallest_first(std::vector<std::int32_t>& rows) {
  std::rotate(rows.begin(), std::min_element(rows.begin(), rows.end()), rows.end());
}

/// Returns the corners of a facet in their order. `begin`, `end`: its sides.
std::vector<Vertex> corners_of(const Mesh& mesh, std::vector<Side>::const_iterator begin,
                               std::vector<Side>::const_iterator end) {
  const auto after = [&](Vertex vertex) {
    return std::lower_bound(begin, end, vertex, [](const Side& side, Vertex v) { return side.from < v; })->to;
  };
  std::vector<Vertex> corners;
  Vertex before = begin->from;
  for (auto side = begin; side != end; ++side) {
    const Vertex here = after(before);
    if (!CGAL::collinear(mesh.point(before), mesh.point(here), mesh.point(after(here))))
      corners.push_back(here);
    before = here;
  }
  return corners;
}

/// Facets of a body. Quickhull visits facets in the order of their addresses. Its triangulation of flat
/// regions, and the points on them that are not corners, differ from run to run.
Polygons facets(const std::vector<Point>& points) {
  const Mesh mesh = quickhull(points);
  const std::vector<Side> sides = sides_of(mesh);
  std::vector<std::vector<Vertex>> polygons;
  for (auto begin = sides.begin(); begin != sides.end();) {
    const auto end =
        std::find_if(begin, sides.end(), [&](const Side& side) { return side.facet != begin->facet; });
    polygons.push_back(corners_of(mesh, begin, end));
    begin = end;
  }
  constexpr std::int32_t no_corner = -1;
  std::vector<std::int32_t> row_of(mesh.number_of_vertices(), no_corner);
  std::vector<Vertex> corners;
  for (const std::vector<Vertex>& polygon : polygons)
    for (const Vertex corner : polygon)
      if (std::int32_t& row = row_of[corner.idx()]; row == no_corner) row = 0, corners.push_back(corner);
  std::sort(corners.begin(), corners.end(),
            [&](Vertex a, Vertex b) { return mesh.point(a) < mesh.point(b); });
  Polygons result;
  for (const Vertex corner : corners) {
    row_of[corner.idx()] = static_cast<std::int32_t>(result.corners.size());
    result.corners.push_back(mesh.point(corner));
  }
  for (const std::vector<Vertex>& polygon : polygons) {
    std::vector<std::int32_t>& rows = result.rows.emplace_back();
    for (const Vertex corner : polygon) rows.push_back(row_of[corner.idx()]);
    put_smallest_first(rows);
  }
  return result;
}

template <typename Projection>
std::vector<Point> polygon_seen(const std::vector<Point>& points) {
  std::vector<Point> corners;
  CGAL::convex_hull_2(points.begin(), points.end(), std::back_inserter(corners), Projection());
  return corners;
}

/// Corners of the hull of points in a plane that do not lie on a line. Their projection along at least one of
/// the axes is not degenerate.
std::vector<Point> flat_polygon(const std::vector<Point>& points) {
  std::vector<Point> corners = polygon_seen<CGAL::Projection_traits_xy_3<Kernel>>(points);
  if (corners.size() < 3) corners = polygon_seen<CGAL::Projection_traits_yz_3<Kernel>>(points);
  if (corners.size() < 3) corners = polygon_seen<CGAL::Projection_traits_xz_3<Kernel>>(points);
  return corners;
}

Polygons single(const std::vector<Point>& polygon) {
  Polygons result{polygon, {{}}};
  std::sort(result.corners.begin(), result.corners.end());
  result.corners.erase(std::unique(result.corners.begin(), result.corners.end()), result.corners.end());
  for (const Point& corner : polygon)
    result.rows[0].push_back(static_cast<std::int32_t>(
        std::lower_bound(result.corners.begin(), result.corners.end(), corner) - result.corners.begin()));
  put_smallest_first(result.rows[0]);
  return result;
}

Polygons polygons_of(const std::vector<Point>& points, int dimension) {
  if (dimension == 3) return facets(points);
  if (dimension == 2) return single(flat_polygon(points));
  const auto [low, high] = std::minmax_element(points.begin(), points.end());
  return single({*low, *high});
}

}  // namespace

TriangulatedHull triangulated_hull(const Points& points) {
  TriangulatedHull hull;
  hull.dimension = affine_dimension(points);
  const auto [corners, polygons] = polygons_of(points_of(points), hull.dimension);
  std::vector<std::array<std::int32_t, 3>> triangles;
  for (const std::vector<std::int32_t>& polygon : polygons)
    for (std::size_t k = 2; k < polygon.size(); ++k)
      triangles.push_back({polygon[0], polygon[k - 1], polygon[k]});
  std::sort(triangles.begin(), triangles.end());

  hull.points.resize(static_cast<Eigen::Index>(corners.size()), 3);
  for (std::size_t i = 0; i < corners.size(); ++i)
    hull.points.row(static_cast<Eigen::Index>(i)) << corners[i].x(), corners[i].y(), corners[i].z();
  hull.triangles.resize(static_cast<Eigen::Index>(triangles.size()), 3);
  for (std::size_t t = 0; t < triangles.size(); ++t)
    hull.triangles.row(static_cast<Eigen::Index>(t)) << triangles[t][0], triangles[t][1], triangles[t][2];
  return hull;
}

}  // namespace stackabilization
