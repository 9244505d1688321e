#include "structure/segmentation/flat_triangles.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "core/index.h"
#include "mesh/edge_table.h"
#include "mesh/welded_mesh.h"
#include "stackabilization/structure/tolerances.h"

namespace stackabilization::detail {

namespace {

double length_of(const WeldedMesh& mesh, std::int32_t triangle, int corner) {
  const auto point = [&](int k) { return mesh.points.row(mesh.triangles(triangle, k % 3)); };
  return (point(corner + 1) - point(corner)).stableNorm();
}

}  // namespace

std::vector<FlatTriangle> flat_triangles(const WeldedMesh& mesh, const EdgeTable& edges) {
  const double height =
      tolerance::flat_triangle * (mesh.points.colwise().maxCoeff() - mesh.points.colwise().minCoeff()).norm();
  std::vector<FlatTriangle> found;
  std::vector<std::int32_t> place(static_cast<std::size_t>(mesh.triangles.rows()), -1);
  for (std::size_t edge = 0; edge < edges.size(); ++edge)
    for (const TriangleSide& side : edges[edge]) {
      const double length = length_of(mesh, side.triangle, side.corner);
      if (2 * mesh.area(side.triangle) > height * length) continue;
      std::int32_t& of_triangle = place[at(side.triangle)];
      if (of_triangle < 0) {
        of_triangle = static_cast<std::int32_t>(found.size());
        found.push_back({side.triangle, length, edge});
      } else if (length > found[at(of_triangle)].length) {
        found[at(of_triangle)] = {side.triangle, length, edge};
      }
    }
  std::sort(found.begin(), found.end(), [](const FlatTriangle& a, const FlatTriangle& b) {
    return a.length != b.length ? a.length > b.length : a.row < b.row;
  });
  return found;
}

Shape with_flat_triangles_at_their_edges(const Shape& shape) {
  const WeldedMesh mesh = weld(shape);
  const EdgeTable edges(mesh.triangles, EdgeTable::Collapsed::keep);
  const std::vector<FlatTriangle> found = flat_triangles(mesh, edges);
  if (found.empty()) return shape;
  Shape result = shape;
  // A shorter one may lie on a longer one, which has found its part by then.
  std::vector<char> unplaced(shape.triangle_part.size(), 0), has_others(shape.part_names.size(), 0);
  for (const FlatTriangle& one : found) unplaced[at(one.row)] = 1;
  for (std::size_t t = 0; t < unplaced.size(); ++t)
    if (!unplaced[t]) has_others[at(shape.triangle_part[t])] = 1;
  for (const FlatTriangle& one : found) {
    std::int32_t& part = result.triangle_part[at(one.row)];
    std::int32_t beside = -1;
    for (const TriangleSide& side : edges[one.edge]) {
      if (unplaced[at(side.triangle)]) continue;
      const std::int32_t other = result.triangle_part[at(side.triangle)];
      if (beside < 0 || other == part) beside = other;
    }
    if (beside < 0) continue;
    unplaced[at(one.row)] = 0;
    if (has_others[at(part)]) part = beside;
  }
  return result;
}

}  // namespace stackabilization::detail
