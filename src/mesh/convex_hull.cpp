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
#include <iterator>
#include <map>
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

/// Successor of each corner on the boundary of a facet, including points between corners.
using Border = std::map<Vertex, Vertex>;

std::vector<Border> borders_of(const Mesh& mesh) {
  DisjointSets facets = facets_of(mesh);
  std::map<std::size_t, Border> borders;
  for (const Mesh::Halfedge_index side : mesh.halfedges()) {
    const std::size_t facet = facets.root(mesh.face(side));
    if (facet != facets.root(mesh.face(mesh.opposite(side))))
      borders[facet][mesh.source(side)] = mesh.target(side);
  }
  std::vector<Border> result;
  for (auto& [facet, border] : borders) result.push_back(std::move(border));
  return result;
}

void put_smallest_first(std::vector<Point>& corners) {
  std::rotate(corners.begin(), std::min_element(corners.begin(), corners.end()), corners.end());
}

/// The corners of a facet, the lexicographically least first.
std::vector<Point> polygon(const Mesh& mesh, const Border& border) {
  std::vector<Point> corners;
  Vertex before = border.begin()->first;
  for (std::size_t k = 0; k < border.size(); ++k) {
    const Vertex here = border.at(before), after = border.at(here);
    if (!CGAL::collinear(mesh.point(before), mesh.point(here), mesh.point(after)))
      corners.push_back(mesh.point(here));
    before = here;
  }
  put_smallest_first(corners);
  return corners;
}

/// Facets of a body. Quickhull visits facets in the order of their addresses. Its triangulation of flat
/// regions, and the points on them that are not corners, differ from run to run.
std::vector<std::vector<Point>> facets(const std::vector<Point>& points) {
  const Mesh mesh = quickhull(points);
  std::vector<std::vector<Point>> polygons;
  for (const Border& border : borders_of(mesh)) polygons.push_back(polygon(mesh, border));
  return polygons;
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
  put_smallest_first(corners);
  return corners;
}

/// Polygons that make up the hull, each with its smallest corner first.
std::vector<std::vector<Point>> polygons_of(const std::vector<Point>& points, int dimension) {
  if (dimension == 3) return facets(points);
  if (dimension == 2) return {flat_polygon(points)};
  const auto [low, high] = std::minmax_element(points.begin(), points.end());
  return {{*low, *high}};
}

}  // namespace

TriangulatedHull triangulated_hull(const Points& points) {
  TriangulatedHull hull;
  hull.dimension = affine_dimension(points);
  const std::vector<std::vector<Point>> polygons = polygons_of(points_of(points), hull.dimension);
  std::vector<Point> corners;
  for (const std::vector<Point>& polygon : polygons)
    corners.insert(corners.end(), polygon.begin(), polygon.end());
  std::sort(corners.begin(), corners.end());
  corners.erase(std::unique(corners.begin(), corners.end()), corners.end());
  const auto row = [&](const Point& p) {
    return static_cast<std::int32_t>(std::lower_bound(corners.begin(), corners.end(), p) - corners.begin());
  };

  std::vector<std::array<std::int32_t, 3>> triangles;
  for (const std::vector<Point>& polygon : polygons)
    for (std::size_t k = 2; k < polygon.size(); ++k)
      triangles.push_back({row(polygon[0]), row(polygon[k - 1]), row(polygon[k])});
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
