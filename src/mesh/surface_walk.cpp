#include "mesh/surface_walk.h"

#include <algorithm>
#include <limits>

#include "core/index.h"
#include "mesh/edge_table.h"
#include "mesh/segment_triangle.h"

namespace stackabilization::detail {

namespace {

constexpr std::size_t max_triangles = 64;

/// Returns the distance to a triangle; not a number if it is collapsed.
double distance_to(const Shape& shape, std::int32_t triangle, const Eigen::Vector3d& point) {
  const Corners corners{shape.corner(triangle, 0), shape.corner(triangle, 1), shape.corner(triangle, 2)};
  return (nearest_on_triangle(point, corners) - point).norm();
}

}  // namespace

SurfaceWalk::SurfaceWalk(const Shape& shape, const WeldedMesh& mesh)
    : neighbours_(static_cast<std::size_t>(shape.triangle_count()), {-1, -1, -1}) {
  const EdgeTable edges(mesh.triangles);
  for (std::size_t edge = 0; edge < edges.size(); ++edge)
    for (const TriangleSide& side : edges[edge])
      for (const TriangleSide& other : edges[edge])
        if (other.triangle != side.triangle &&
            shape.triangle_part[at(other.triangle)] == shape.triangle_part[at(side.triangle)])
          neighbours_[at(side.triangle)][at(side.corner)] = other.triangle;
}

double SurfaceWalk::distance(const Shape& shape, const Eigen::Vector3d& point, std::int32_t start) const {
  double best = std::numeric_limits<double>::infinity();
  if (const double first = distance_to(shape, start, point); first < best) best = first;
  std::vector<std::int32_t> seen{start}, next{start};
  while (!next.empty()) {
    const std::int32_t triangle = next.back();
    next.pop_back();
    for (const std::int32_t other : neighbours_[at(triangle)]) {
      if (other < 0 || seen.size() == max_triangles) continue;
      if (std::find(seen.begin(), seen.end(), other) != seen.end()) continue;
      seen.push_back(other);
      const double distance = distance_to(shape, other, point);
      if (!(distance <= best)) continue;
      best = distance;
      next.push_back(other);
    }
  }
  return best;
}

}  // namespace stackabilization::detail
