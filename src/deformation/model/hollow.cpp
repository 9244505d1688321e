#include "deformation/model/hollow.h"

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>
#include <numbers>
#include <variant>
#include <vector>

#include "core/extract_parts.h"
#include "mesh/ray_crossings.h"
#include "stackabilization/core/tolerances.h"
#include "stackabilization/mesh/exact_triangles.h"
#include "structure/model/nearest_box.h"

namespace stackabilization::detail {

namespace {

using Tree = TriangleTree<CGAL::Exact_predicates_inexact_constructions_kernel>;

/// Number of rays across the curve between two sections.
constexpr int rays = 16;
/// Least share of the rays that find a wall.
constexpr double min_share = 0.75;
/// Distances between which the outer side of the wall lies, radii of the section or half extents of the box.
constexpr double nearest_outer = 0.75, farthest_outer = 1.25;
/// Rays start in a grid of places in the middle plane of a box, this far from its centre along either side,
/// half extents. Those near the rim of the plane meet rounded corners, or miss a box that narrows: they do
/// not decide whether there is a wall.
constexpr double ray_step = 0.1;
constexpr int ray_rim = 9, deciding_rim = 7;
/// Least distance of a wall of a box from its centre, half extents.
constexpr double nearest_inner = 0.5;

/// Returns the median distance from the curve to the inner side of the wall, half-way along a piece of the
/// curve; 0 if there is no wall.
double inner_radius(const Tree& tree, const Shape& part, const GeneralizedCylinder& cylinder,
                    Eigen::Index from, Eigen::Index to) {
  const Eigen::Vector3d a = cylinder.centres.row(from), b = cylinder.centres.row(to);
  const Eigen::Vector3d along = (b - a).normalized(), u = along.unitOrthogonal(), v = along.cross(u);
  const double radius = (cylinder.radii(from) + cylinder.radii(to)) / 2;
  const double reach = tolerance::relative * radius;
  std::vector<double> found;
  for (int k = 0; k < rays; ++k) {
    // The odd angle keeps rays off the edges of regular meshes.
    const double angle = 0.1 + 2 * std::numbers::pi * k / rays;
    std::vector<Crossing> met = crossings(tree, part, (a + b) / 2, std::cos(angle) * u + std::sin(angle) * v,
                                          0, farthest_outer * radius);
    merge_at_edges(met, reach);
    if (met.size() == 2 && met[1].distance > nearest_outer * radius) found.push_back(met[0].distance);
  }
  if (static_cast<double>(found.size()) < min_share * rays) return 0;
  const auto middle = found.begin() + static_cast<std::ptrdiff_t>(found.size() / 2);
  std::nth_element(found.begin(), middle, found.end());
  return *middle;
}

/// Returns the distance from the centre to the innermost place of the wall that rays along `half_axis` meet,
/// fraction of its length; 1 if there is no wall. `u`, `v`: the other half axes.
double inner_side(const Tree& tree, const Shape& part, const Eigen::Vector3d& centre,
                  const Eigen::Vector3d& half_axis, const Eigen::Vector3d& u, const Eigen::Vector3d& v) {
  const double length = half_axis.norm(), reach = tolerance::relative * length;
  double inner = length;
  const auto meets_wall = [&](int i, int j) {
    std::vector<Crossing> met = crossings(tree, part, centre + ray_step * (i * u + j * v), half_axis / length,
                                          0, farthest_outer * length);
    merge_at_edges(met, reach);
    if (met.size() != 2 || met[0].distance < nearest_inner * length ||
        met[1].distance < nearest_outer * length)
      return false;
    inner = std::min(inner, met[0].distance);
    return true;
  };
  constexpr int side = 2 * deciding_rim + 1;
  int misses = 0;
  for (int i = -deciding_rim; i <= deciding_rim; ++i)
    for (int j = -deciding_rim; j <= deciding_rim; ++j)
      if (!meets_wall(i, j) && ++misses > (1 - min_share) * side * side) return 1;
  for (int i = -ray_rim; i <= ray_rim; ++i)
    for (int j = -ray_rim; j <= ray_rim; ++j)
      if (std::max(std::abs(i), std::abs(j)) > deciding_rim) meets_wall(i, j);
  return inner / length;
}

}  // namespace

Eigen::Matrix<double, 3, 2> inner_sides(const Shape& part, const Cuboid& box) {
  const Tree tree(part, triangles_with_area(part));
  const Eigen::Vector3d centre = box.corners.colwise().mean();
  std::array<Eigen::Vector3d, 3> half;
  for (int axis = 0; axis < 3; ++axis)
    half[static_cast<std::size_t>(axis)] = (box.corners.row(1 << axis) - box.corners.row(0)) / 2;
  Eigen::Matrix<double, 3, 2> sides = Eigen::Matrix<double, 3, 2>::Ones();
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const Eigen::Vector3d &u = half[(axis + 1) % 3], &v = half[(axis + 2) % 3];
    const double below = inner_side(tree, part, centre, -half[axis], u, v);
    if (below == 1) continue;
    const double above = inner_side(tree, part, centre, half[axis], u, v);
    if (above < 1) sides.row(static_cast<Eigen::Index>(axis)) << below, above;
  }
  return sides;
}

Eigen::VectorXd inner_radii(const Shape& part, const GeneralizedCylinder& cylinder) {
  const Tree tree(part, triangles_with_area(part));
  const Eigen::Index n = cylinder.centres.rows(), pieces = n - (cylinder.closed ? 0 : 1);
  Eigen::VectorXd sums = Eigen::VectorXd::Zero(n), counts = Eigen::VectorXd::Zero(n);
  for (Eigen::Index i = 0; i < pieces; ++i) {
    const double inner = inner_radius(tree, part, cylinder, i, (i + 1) % n);
    if (!(inner > 0)) continue;
    for (const Eigen::Index section : {i, (i + 1) % n}) {
      sums(section) += inner;
      counts(section) += 1;
    }
  }
  if (counts.isZero(0)) return {};
  return (sums.array() / counts.array().max(1)).min(cylinder.radii.array());
}

void keep_walls(StructuredShape& structured) {
  const std::vector<Shape> parts = extract_parts(structured.shape);
  for (std::size_t part = 0; part < parts.size(); ++part) {
    Primitive& primitive = structured.structure.parts[part].primitive;
    if (auto* cylinder = std::get_if<GeneralizedCylinder>(&primitive))
      cylinder->inner_radii = inner_radii(parts[part], *cylinder);
    else if (auto& cuboid = std::get<Cuboid>(primitive); is_box(cuboid))
      cuboid.inner_sides = inner_sides(parts[part], cuboid);
  }
}

}  // namespace stackabilization::detail
