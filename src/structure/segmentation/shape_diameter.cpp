#include "structure/segmentation/shape_diameter.h"

#include <CGAL/Simple_cartesian.h>
#include <CGAL/Surface_mesh.h>
#include <CGAL/mesh_segmentation.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <exception>
#include <map>
#include <set>

#include "mesh/oriented_mesh.h"
#include "mesh/welded_mesh.h"
#include "structure/segmentation/segment_boundaries.h"

namespace stackabilization::detail {

namespace {

using Kernel = CGAL::Simple_cartesian<double>;
using Mesh = CGAL::Surface_mesh<Kernel::Point_3>;

/// Clusters of diameters: CGAL's default, and the most that are tried for a given number of parts.
constexpr std::size_t default_clusters = 5, cluster_limit = 12;

struct OutwardMesh {
  Mesh mesh;
  std::vector<std::int32_t> triangle_of_face;
};

OutwardMesh outward_mesh(const Shape& shape, const SurfaceGraph& graph) {
  const OrientedMesh surface = orient(weld(shape));
  OutwardMesh result;
  for (const auto p : surface.points.rowwise()) result.mesh.add_vertex(Kernel::Point_3(p(0), p(1), p(2)));
  for (Eigen::Index f = 0; f < surface.triangles.rows(); ++f) {
    const std::int32_t t = surface.source[static_cast<std::size_t>(f)];
    if (!(graph.areas(t) > 0)) continue;
    std::array<Mesh::Vertex_index, 3> corners;
    std::array<Eigen::Vector3d, 3> points;
    for (std::size_t k = 0; k < 3; ++k) {
      const std::int32_t v = surface.triangles(f, static_cast<Eigen::Index>(k));
      points[k] = surface.points.row(v).transpose();
      corners[k] = Mesh::Vertex_index(static_cast<Mesh::size_type>(v));
    }
    if ((points[1] - points[0]).cross(points[2] - points[0]).dot(graph.normals.row(t).transpose()) < 0)
      std::swap(corners[1], corners[2]);
    if (result.mesh.add_face(corners[0], corners[1], corners[2]) != Mesh::null_face())
      result.triangle_of_face.push_back(t);
  }
  return result;
}

/// CGAL's graph cut reads beyond an empty list where no two faces have an edge in common.
bool has_neighbours(const Mesh& mesh) {
  const auto edges = mesh.edges();
  return std::any_of(edges.begin(), edges.end(),
                     [&](Mesh::Edge_index edge) { return !mesh.is_border(edge); });
}

/// Segments of the faces for a number of clusters.
std::vector<std::int32_t> segments(const Mesh& mesh, const std::vector<double>& diameters,
                                   std::size_t clusters) {
  std::vector<std::size_t> segment(diameters.size());
  const auto diameter_map =
      boost::make_iterator_property_map(diameters.begin(), get(boost::face_index, mesh));
  const auto segment_map = boost::make_iterator_property_map(segment.begin(), get(boost::face_index, mesh));
  CGAL::segmentation_from_sdf_values(mesh, diameter_map, segment_map, clusters);
  return {segment.begin(), segment.end()};
}

std::size_t different(const std::vector<std::int32_t>& part) {
  return std::set<std::int32_t>(part.begin(), part.end()).size();
}

/// Joins the smallest part to the neighbour with the strongest link, until `parts` are left.
std::vector<std::int32_t> reduced(const SurfaceGraph& graph, std::vector<std::int32_t> part,
                                  std::size_t parts) {
  while (different(part) > parts) {
    std::map<std::int32_t, double> area;
    for (std::size_t t = 0; t < part.size(); ++t) area[part[t]] += graph.areas(static_cast<Eigen::Index>(t));
    const auto smallest = std::min_element(area.begin(), area.end(),
                                           [](const auto& a, const auto& b) { return a.second < b.second; });
    const std::size_t before = area.size();
    part = merge_small_segments(graph, part, std::nextafter(smallest->second, smallest->second * 2));
    if (different(part) >= before) break;
  }
  return part;
}

}  // namespace

std::vector<std::int32_t> shape_diameter_parts(const Shape& shape, const SurfaceGraph& graph, int parts) {
  const std::vector<std::int32_t> whole(static_cast<std::size_t>(graph.size()), 0);
  const OutwardMesh outward = outward_mesh(shape, graph);
  if (!has_neighbours(outward.mesh)) return whole;
  std::vector<double> diameters(outward.triangle_of_face.size());
  try {
    const auto map =
        boost::make_iterator_property_map(diameters.begin(), get(boost::face_index, outward.mesh));
    const auto [least, most] = CGAL::sdf_values(outward.mesh, map);
    if (!(least < most) ||
        !std::all_of(diameters.begin(), diameters.end(), [](double d) { return d >= 0 && d <= 1; }))
      return whole;
    // CGAL does not terminate for more clusters than different diameters.
    const std::size_t max_clusters =
        std::min(cluster_limit, std::set<double>(diameters.begin(), diameters.end()).size());
    std::vector<std::int32_t> found;
    std::size_t clusters = std::min(max_clusters, parts > 0 ? std::size_t{2} : default_clusters);
    do {
      found = segments(outward.mesh, diameters, clusters);
    } while (parts > 0 && different(found) < static_cast<std::size_t>(parts) && ++clusters <= max_clusters);
    // Triangles without area have no face. They form a segment of their own, which is merged as a small
    // segment.
    std::vector<std::int32_t> part(whole.size(), -1);
    for (std::size_t f = 0; f < found.size(); ++f)
      part[static_cast<std::size_t>(outward.triangle_of_face[f])] = found[f];
    part = merge_small_segments(graph, part, 0);
    return parts > 0 ? reduced(graph, std::move(part), static_cast<std::size_t>(parts)) : part;
  } catch (const std::exception&) {  // CGAL's own checks
    return whole;
  }
}

}  // namespace stackabilization::detail
