#include "stackabilization/stacking/closed_surface.h"

#include <algorithm>
#include <map>
#include <numeric>
#include <tuple>
#include <utility>

namespace stackabilization {

namespace {

using CornerIds = std::vector<std::array<std::int32_t, 3>>;

enum class Welding { none, equal_coordinates, equal_coordinates_per_part };

CornerIds corner_ids(const Shape& shape, Welding welding) {
  CornerIds ids(static_cast<std::size_t>(shape.triangle_count()));
  std::map<std::tuple<std::int32_t, double, double, double>, std::int32_t> known;
  for (std::size_t t = 0; t < ids.size(); ++t)
    for (std::size_t k = 0; k < 3; ++k) {
      const std::int32_t vertex = shape.triangles(static_cast<Eigen::Index>(t), static_cast<Eigen::Index>(k));
      if (welding == Welding::none) {
        ids[t][k] = vertex;
        continue;
      }
      const std::int32_t part = welding == Welding::equal_coordinates ? 0 : shape.triangle_part[t];
      const auto p = shape.vertices.row(vertex);
      const auto next = static_cast<std::int32_t>(known.size());
      ids[t][k] = known.try_emplace({part, p.x(), p.y(), p.z()}, next).first->second;
    }
  return ids;
}

/// Root of a union-find forest, with path halving.
std::int32_t root_of(std::vector<std::int32_t>& parent, std::int32_t t) {
  while (parent[static_cast<std::size_t>(t)] != t) {
    std::int32_t& above = parent[static_cast<std::size_t>(t)];
    t = above = parent[static_cast<std::size_t>(above)];
  }
  return t;
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
  std::vector<std::int32_t> parent(ids.size());
  std::iota(parent.begin(), parent.end(), 0);
  for (const auto& [edge, owner] : edges) {
    const auto reverse = edges.find({edge.second, edge.first});
    if (reverse == edges.end()) return {};
    const auto [neighbour, corner] = reverse->second;
    surface.opposite[static_cast<std::size_t>(owner.triangle)][static_cast<std::size_t>(owner.corner)] =
        shape.triangles(neighbour, (corner + 2) % 3);
    const std::int32_t a = root_of(parent, owner.triangle), b = root_of(parent, neighbour);
    parent[static_cast<std::size_t>(std::max(a, b))] = std::min(a, b);
  }
  surface.component.assign(ids.size(), -1);
  for (std::size_t t = 0; t < ids.size(); ++t) {
    if (has_equal_corners(ids[t])) continue;
    const auto root = static_cast<std::size_t>(root_of(parent, static_cast<std::int32_t>(t)));
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
