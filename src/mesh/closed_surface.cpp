#include "stackabilization/mesh/closed_surface.h"

#include <array>
#include <map>
#include <utility>

#include "core/disjoint_sets.h"
#include "mesh/point_index.h"

namespace stackabilization {

namespace {

using CornerIds = std::vector<std::array<std::int32_t, 3>>;

enum class Welding { none, equal_coordinates, equal_coordinates_per_part };

/// Vertex rows of all corners, or numbers that two corners share when they are welded.
CornerIds corner_ids(const Shape& shape, Welding welding) {
  CornerIds ids(static_cast<std::size_t>(shape.triangle_count()));
  const bool by_part = welding == Welding::equal_coordinates_per_part;
  std::vector<PointIndex> indices(by_part ? static_cast<std::size_t>(shape.part_count()) : 1);
  for (std::size_t t = 0; t < ids.size(); ++t)
    for (std::size_t k = 0; k < 3; ++k) {
      const auto triangle = static_cast<Eigen::Index>(t);
      const auto part = by_part ? static_cast<std::size_t>(shape.triangle_part[t]) : 0;
      ids[t][k] = welding == Welding::none
                      ? shape.triangles(triangle, static_cast<Eigen::Index>(k))
                      : indices[part].insert(shape.corner(triangle, static_cast<int>(k)));
    }
  if (!by_part) return ids;
  std::vector<std::int32_t> first(indices.size(), 0);
  for (std::size_t part = 1; part < first.size(); ++part)
    first[part] = first[part - 1] + static_cast<std::int32_t>(indices[part - 1].points().size());
  for (std::size_t t = 0; t < ids.size(); ++t)
    for (std::int32_t& id : ids[t]) id += first[static_cast<std::size_t>(shape.triangle_part[t])];
  return ids;
}

bool has_equal_corners(const std::array<std::int32_t, 3>& ids) {
  return ids[0] == ids[1] || ids[1] == ids[2] || ids[2] == ids[0];
}

struct EdgeOwner {
  std::int32_t triangle, corner;
};

ClosedSurface connect(const Shape& shape, const CornerIds& ids) {
  std::map<std::pair<std::int32_t, std::int32_t>, EdgeOwner> edges;
  for (std::size_t t = 0; t < ids.size(); ++t) {
    if (has_equal_corners(ids[t])) continue;
    for (std::size_t k = 0; k < 3; ++k) {
      const EdgeOwner owner{static_cast<std::int32_t>(t), static_cast<std::int32_t>(k)};
      if (!edges.try_emplace({ids[t][k], ids[t][(k + 1) % 3]}, owner).second) return {};
    }
  }
  ClosedSurface surface;
  surface.opposite.resize(ids.size());
  DisjointSets components(ids.size());
  for (const auto& [edge, owner] : edges) {
    const auto reverse = edges.find({edge.second, edge.first});
    if (reverse == edges.end()) return {};
    const auto [neighbour, corner] = reverse->second;
    surface.opposite[static_cast<std::size_t>(owner.triangle)][static_cast<std::size_t>(owner.corner)] =
        shape.triangles(neighbour, (corner + 2) % 3);
    components.join(static_cast<std::size_t>(owner.triangle), static_cast<std::size_t>(neighbour));
  }
  surface.component.assign(ids.size(), -1);
  for (std::size_t t = 0; t < ids.size(); ++t) {
    if (has_equal_corners(ids[t])) continue;
    const std::size_t root = components.root(t);
    if (root == t) {
      surface.component[t] = static_cast<std::int32_t>(surface.representatives.size());
      surface.representatives.push_back(static_cast<std::int32_t>(t));
    } else {
      surface.component[t] = surface.component[root];
    }
  }
  surface.closed = !edges.empty();
  return surface;
}

}  // namespace

ClosedSurface closed_surface(const Shape& shape) {
  for (const Welding welding :
       {Welding::none, Welding::equal_coordinates, Welding::equal_coordinates_per_part}) {
    ClosedSurface surface = connect(shape, corner_ids(shape, welding));
    if (surface.closed) return surface;
  }
  return {};
}

}  // namespace stackabilization
