#include "mesh/oriented_mesh.h"

#include <CGAL/Polygon_mesh_processing/orient_polygon_soup.h>
#include <CGAL/Polygon_mesh_processing/orient_polygon_soup_extension.h>
#include <CGAL/Simple_cartesian.h>

#include <array>

namespace stackabilization::detail {

OrientedMesh orient(const WeldedMesh& mesh) {
  using Point = CGAL::Simple_cartesian<double>::Point_3;
  std::vector<Point> points;
  for (const auto p : mesh.points.rowwise()) points.emplace_back(p(0), p(1), p(2));
  std::vector<std::array<std::size_t, 3>> triangles;
  OrientedMesh oriented;
  for (std::int32_t t = 0; t < mesh.triangles.rows(); ++t) {
    if (mesh.has_equal_corners(t)) continue;
    const Eigen::Matrix<std::size_t, 1, 3> corner = mesh.triangles.row(t).cast<std::size_t>();
    triangles.push_back({corner(0), corner(1), corner(2)});
    oriented.source.push_back(t);
  }

  // CGAL appends copies of the points it repeats, and leaves the order of the triangles alone.
  CGAL::Polygon_mesh_processing::orient_polygon_soup(points, triangles);
  oriented.points.resize(static_cast<Eigen::Index>(points.size()), 3);
  for (Eigen::Index v = 0; v < oriented.points.rows(); ++v) {
    const Point& p = points[static_cast<std::size_t>(v)];
    oriented.points.row(v) << p.x(), p.y(), p.z();
  }
  oriented.triangles.resize(static_cast<Eigen::Index>(triangles.size()), 3);
  for (Eigen::Index t = 0; t < oriented.triangles.rows(); ++t)
    for (int k = 0; k < 3; ++k)
      oriented.triangles(t, k) =
          static_cast<std::int32_t>(triangles[static_cast<std::size_t>(t)][static_cast<std::size_t>(k)]);
  return oriented;
}

}  // namespace stackabilization::detail
