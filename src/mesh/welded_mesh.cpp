#include "mesh/welded_mesh.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <map>

#include "core/disjoint_sets.h"
#include "core/index.h"
#include "mesh/point_index.h"
#include "mesh/surface_moments.h"

namespace stackabilization::detail {

bool WeldedMesh::has_equal_corners(Eigen::Index triangle) const {
  const auto corner = triangles.row(triangle);
  return corner(0) == corner(1) || corner(1) == corner(2) || corner(2) == corner(0);
}

double WeldedMesh::area(Eigen::Index triangle) const {
  const Eigen::Vector3d a = points.row(triangles(triangle, 0));
  const Eigen::Vector3d b = points.row(triangles(triangle, 1)), c = points.row(triangles(triangle, 2));
  return area_vector(a, b, c).norm();
}

std::vector<std::int32_t> WeldedMesh::first_copies() const {
  std::map<std::array<std::int32_t, 3>, std::int32_t> known;
  std::vector<std::int32_t> first;
  first.reserve(static_cast<std::size_t>(triangles.rows()));
  for (std::int32_t t = 0; t < triangles.rows(); ++t) {
    std::array<std::int32_t, 3> corners{triangles(t, 0), triangles(t, 1), triangles(t, 2)};
    std::sort(corners.begin(), corners.end());
    first.push_back(known.try_emplace(corners, t).first->second);
  }
  return first;
}

WeldedMesh weld(const Shape& shape, Weld which) {
  WeldedMesh mesh;
  mesh.of_vertex.assign(at(static_cast<std::int32_t>(shape.vertex_count())), -1);
  mesh.triangles.resize(shape.triangle_count(), 3);
  // Per part, or once for all, the numbers that its points have in the whole mesh.
  struct Welder {
    PointIndex points;
    std::vector<std::int32_t> numbers;
  };
  const bool within_parts = which == Weld::within_parts;
  std::vector<Welder> welders(within_parts ? at(static_cast<std::int32_t>(shape.part_count())) : 1);
  for (Eigen::Index t = 0; t < shape.triangle_count(); ++t) {
    Welder& welder = welders[within_parts ? at(shape.triangle_part[static_cast<std::size_t>(t)]) : 0];
    for (int k = 0; k < 3; ++k) {
      const std::int32_t vertex = shape.triangles(t, k);
      std::int32_t& row = mesh.of_vertex[at(vertex)];
      if (row < 0 || within_parts) {  // another part may have used the vertex
        const std::size_t known = at(welder.points.insert(shape.vertices.row(vertex).transpose()));
        if (known == welder.numbers.size()) {
          welder.numbers.push_back(static_cast<std::int32_t>(mesh.first_vertex.size()));
          mesh.first_vertex.push_back(vertex);
        }
        row = welder.numbers[known];
      }
      mesh.triangles(t, k) = row;
    }
  }
  mesh.points = shape.vertices(mesh.first_vertex, Eigen::all);
  return mesh;
}

std::vector<std::int32_t> connected_components(const WeldedMesh& mesh) {
  DisjointSets sets(static_cast<std::size_t>(mesh.triangles.rows()));
  std::vector<std::int32_t> first(static_cast<std::size_t>(mesh.points.rows()),
                                  -1);  // per point, its first triangle
  for (std::int32_t t = 0; t < mesh.triangles.rows(); ++t)
    for (const std::int32_t point : mesh.triangles.row(t)) {
      std::int32_t& known = first[at(point)];
      if (known < 0) known = t;
      sets.join(at(known), at(t));
    }
  return sets.numbers();
}

}  // namespace stackabilization::detail
