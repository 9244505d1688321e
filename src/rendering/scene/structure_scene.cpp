#include "rendering/scene/structure_scene.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <utility>

#include "core/disjoint_sets.h"

namespace stackabilization::detail {
namespace {

constexpr std::array<Colour, 10> clear_hues{{{0.27, 0.47, 0.78},
                                             {0.96, 0.62, 0.18},
                                             {0.55, 0.36, 0.70},
                                             {0.16, 0.62, 0.67},
                                             {0.93, 0.80, 0.27},
                                             {0.90, 0.52, 0.70},
                                             {0.56, 0.39, 0.27},
                                             {0.53, 0.75, 0.92},
                                             {0.72, 0.66, 0.88},
                                             {0.85, 0.69, 0.52}}};
constexpr std::array<Colour, 6> quiet_hues{{{0.82, 0.76, 0.63},
                                            {0.62, 0.69, 0.78},
                                            {0.71, 0.77, 0.65},
                                            {0.81, 0.69, 0.66},
                                            {0.71, 0.67, 0.78},
                                            {0.62, 0.62, 0.61}}};

/// Returns colour k of an infinite list: each further round is paler.
template <std::size_t Count>
Colour hue(const std::array<Colour, Count>& hues, std::size_t k) {
  const double fade = 1 - std::pow(0.6, static_cast<double>(k / Count));
  return mix(hues[k % Count], palette::white, fade);
}

/// Two unit vectors that complete a unit vector to an orthonormal frame.
std::pair<Eigen::Vector3d, Eigen::Vector3d> across(const Eigen::Vector3d& axis) {
  const Eigen::Vector3d u = axis.unitOrthogonal();
  return {u, axis.cross(u)};
}

/// Closed polyline of a circle.
Points circle_around(const Eigen::Vector3d& centre, const Eigen::Vector3d& axis, double radius) {
  constexpr int sides = 40;
  const auto [u, v] = across(axis);
  Points points(sides + 1, 3);
  for (int k = 0; k <= sides; ++k) {
    const double angle = 2 * std::numbers::pi * (k % sides) / sides;
    points.row(k) = (centre + radius * (std::cos(angle) * u + std::sin(angle) * v)).transpose();
  }
  return points;
}

/// Surface over a grid of rows x columns points, its columns closed to a ring.
Shape ring_grid(Points points, int rows, int columns) {
  Triangles triangles(2 * (rows - 1) * columns, 3);
  Eigen::Index face = 0;
  for (int i = 0; i + 1 < rows; ++i)
    for (int j = 0; j < columns; ++j) {
      const int a = i * columns + j, b = i * columns + (j + 1) % columns;
      triangles.row(face++) << a, b, b + columns;
      triangles.row(face++) << a, b + columns, a + columns;
    }
  return make_shape(std::move(points), std::move(triangles));
}

Points edges_of(const Cuboid& cuboid, int axis, int which) {
  // The four edges along an axis start at the corners without its bit.
  const int b = 1 << (axis + 1) % 3, c = 1 << (axis + 2) % 3;
  const int start = ((which & 1) != 0 ? b : 0) | ((which & 2) != 0 ? c : 0);
  Points edge(2, 3);
  edge.row(0) = cuboid.corners.row(start);
  edge.row(1) = cuboid.corners.row(start | 1 << axis);
  return edge;
}

}  // namespace

std::vector<std::vector<int>> symmetry_orbits(const Structure& structure) {
  const std::size_t count = structure.parts.size();
  DisjointSets sets(count);
  for (const Relation& relation : structure.relations)
    if (relation.type == RelationType::symmetry)
      sets.join(static_cast<std::size_t>(relation.parts[0]), static_cast<std::size_t>(relation.parts[1]));
  std::vector<std::vector<int>> of_root(count), orbits;
  for (std::size_t part = 0; part < count; ++part) of_root[sets.root(part)].push_back(static_cast<int>(part));
  for (std::vector<int>& orbit : of_root)
    if (!orbit.empty()) orbits.push_back(std::move(orbit));
  std::sort(orbits.begin(), orbits.end(), [](const std::vector<int>& a, const std::vector<int>& b) {
    return a.size() != b.size() ? a.size() > b.size() : a.front() < b.front();
  });
  return orbits;
}

std::vector<Colour> part_colours(const Structure& structure) {
  std::vector<Colour> colours(structure.parts.size());
  std::size_t together = 0, alone = 0;
  for (const std::vector<int>& orbit : symmetry_orbits(structure)) {
    const Colour colour = orbit.size() > 1 ? hue(clear_hues, together++) : hue(quiet_hues, alone++);
    for (const int part : orbit) colours[static_cast<std::size_t>(part)] = colour;
  }
  return colours;
}

Shape ball(const Eigen::Vector3d& centre, double radius) {
  constexpr int rows = 9, columns = 14;
  Points points(rows * columns, 3);
  for (int i = 0; i < rows; ++i)
    for (int j = 0; j < columns; ++j) {
      const double polar = std::numbers::pi * i / (rows - 1), around = 2 * std::numbers::pi * j / columns;
      points.row(i * columns + j) =
          centre.transpose() + radius * Eigen::RowVector3d(std::sin(polar) * std::cos(around),
                                                           std::sin(polar) * std::sin(around),
                                                           std::cos(polar));
    }
  return ring_grid(std::move(points), rows, columns);
}

Shape bar(const Eigen::Vector3d& from, const Eigen::Vector3d& to, double radius) {
  if (!((to - from).norm() > 0)) return ball(from, radius);
  constexpr int columns = 14;
  const auto [u, v] = across((to - from).normalized());
  Points points(4 * columns, 3);
  const std::array<std::pair<Eigen::Vector3d, double>, 4> rings{
      {{from, 0.0}, {from, radius}, {to, radius}, {to, 0.0}}};
  for (int i = 0; i < 4; ++i)
    for (int j = 0; j < columns; ++j) {
      const double angle = 2 * std::numbers::pi * j / columns;
      const auto& [centre, size] = rings[static_cast<std::size_t>(i)];
      points.row(i * columns + j) = (centre + size * (std::cos(angle) * u + std::sin(angle) * v)).transpose();
    }
  return ring_grid(std::move(points), 4, columns);
}

Points section_circle(const GeneralizedCylinder& cylinder, Eigen::Index section) {
  const Eigen::Vector3d tangent = section_tangents(cylinder).row(section).transpose();
  return circle_around(cylinder.centres.row(section).transpose(), tangent, cylinder.radii(section));
}

std::vector<Points> outline(const Primitive& primitive) {
  std::vector<Points> lines;
  if (const auto* cuboid = std::get_if<Cuboid>(&primitive)) {
    for (int axis = 0; axis < 3; ++axis)
      for (int which = 0; which < 4; ++which) lines.push_back(edges_of(*cuboid, axis, which));
    return lines;
  }
  const auto& cylinder = std::get<GeneralizedCylinder>(primitive);
  const Eigen::Index n = cylinder.centres.rows();
  for (Eigen::Index i = 0; i < n; ++i) lines.push_back(section_circle(cylinder, i));
  Points curve(n + (cylinder.closed ? 1 : 0), 3);
  curve.topRows(n) = cylinder.centres;
  curve.bottomRows(1) = cylinder.closed ? cylinder.centres.row(0) : cylinder.centres.row(n - 1);
  lines.push_back(std::move(curve));
  return lines;
}

Shape faces(const Primitive& primitive) {
  const auto* const cuboid = std::get_if<Cuboid>(&primitive);
  if (cuboid == nullptr) return {};
  Triangles triangles(12, 3);
  for (int face = 0; face < 6; ++face) {
    const std::array<int, 4> ring = cuboid_face(face);
    triangles.row(2 * face) << ring[0], ring[1], ring[2];
    triangles.row(2 * face + 1) << ring[0], ring[2], ring[3];
  }
  return make_shape(cuboid->corners, std::move(triangles));
}

Points plane_in_box(const Eigen::Vector3d& point, const Eigen::Vector3d& normal, const OrientedBox& box) {
  const Cuboid cuboid = cuboid_of(box);
  std::vector<Eigen::Vector3d> crossings;
  for (int axis = 0; axis < 3; ++axis)
    for (int which = 0; which < 4; ++which) {
      const Points edge = edges_of(cuboid, axis, which);
      const Eigen::Vector3d a = edge.row(0).transpose(), b = edge.row(1).transpose();
      const double from = normal.dot(a - point), to = normal.dot(b - point);
      if ((from < 0) != (to < 0)) crossings.emplace_back(a + from / (from - to) * (b - a));
    }
  if (crossings.size() < 3) return {};
  Eigen::Vector3d centre = Eigen::Vector3d::Zero();
  for (const Eigen::Vector3d& crossing : crossings)
    centre += crossing / static_cast<double>(crossings.size());
  const auto [u, v] = across(normal.normalized());
  const auto angle = [&, &u_axis = u, &v_axis = v](const Eigen::Vector3d& p) {
    return std::atan2(v_axis.dot(p - centre), u_axis.dot(p - centre));
  };
  std::sort(crossings.begin(), crossings.end(),
            [&](const Eigen::Vector3d& a, const Eigen::Vector3d& b) { return angle(a) < angle(b); });
  Points border(static_cast<Eigen::Index>(crossings.size()) + 1, 3);
  for (Eigen::Index i = 0; i < border.rows(); ++i)
    border.row(i) = crossings[static_cast<std::size_t>(i) % crossings.size()].transpose();
  return border;
}

}  // namespace stackabilization::detail
