#include "stackabilization/mesh/closed_surface.h"

#include "core/disjoint_sets.h"
#include "core/index.h"
#include "mesh/edge_table.h"
#include "mesh/welded_mesh.h"

namespace stackabilization {

namespace {

using detail::at;

/// Connects triangles, whose rows of `ids` name corners that are one by the same number.
ClosedSurface connect(const Shape& shape, const Triangles& ids) {
  const detail::EdgeTable edges(ids);
  if (edges.size() == 0) return {};
  for (std::size_t e = 0; e < edges.size(); ++e)
    if (edges[e].size() != 2 || edges[e][0].forward == edges[e][1].forward) return {};

  ClosedSurface surface;
  const auto count = static_cast<std::size_t>(ids.rows());
  surface.opposite.resize(count);
  DisjointSets components(count);
  std::vector<bool> has_sides(count);
  for (std::size_t e = 0; e < edges.size(); ++e)
    for (std::size_t k = 0; k < 2; ++k) {
      const detail::TriangleSide &side = edges[e][k], &other = edges[e][1 - k];
      surface.opposite[at(side.triangle)][at(side.corner)] =
          shape.triangles(other.triangle, (other.corner + 2) % 3);
      components.join(at(side.triangle), at(other.triangle));
      has_sides[at(side.triangle)] = true;
    }
  surface.component.assign(count, -1);
  for (std::size_t t = 0; t < count; ++t) {
    if (!has_sides[t]) continue;
    const std::size_t root = components.root(t);
    if (root == t) {
      surface.component[t] = static_cast<std::int32_t>(surface.representatives.size());
      surface.representatives.push_back(static_cast<std::int32_t>(t));
    } else {
      surface.component[t] = surface.component[root];
    }
  }
  surface.closed = true;
  return surface;
}

}  // namespace

ClosedSurface closed_surface(const Shape& shape) {
  ClosedSurface surface = connect(shape, shape.triangles);
  for (const detail::Weld which : {detail::Weld::all, detail::Weld::within_parts})
    if (!surface.closed) surface = connect(shape, detail::weld(shape, which).triangles);
  return surface;
}

}  // namespace stackabilization
