#include "deformation/model/hollow.h"

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <numbers>
#include <variant>
#include <vector>

#include "core/extract_parts.h"
#include "mesh/ray_crossings.h"
#include "stackabilization/core/tolerances.h"
#include "stackabilization/mesh/exact_triangles.h"

namespace stackabilization::detail {

namespace {

using Tree = TriangleTree<CGAL::Exact_predicates_inexact_constructions_kernel>;

/// Number of rays across the curve between two sections.
constexpr int rays = 16;
/// Least share of the rays that find a wall.
constexpr double most = 0.75;
/// Distances between which the outer side of the wall lies, radii of the section.
constexpr double nearest_outer = 0.75, farthest_outer = 1.25;

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
  if (static_cast<double>(found.size()) < most * rays) return 0;
  const auto middle = found.begin() + static_cast<std::ptrdiff_t>(found.size() / 2);
  std::nth_element(found.begin(), middle, found.end());
  return *middle;
}

}  // namespace

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
  for (std::size_t part = 0; part < parts.size(); ++part)
    if (auto* cylinder = std::get_if<GeneralizedCylinder>(&structured.structure.parts[part].primitive))
      cylinder->inner_radii = inner_radii(parts[part], *cylinder);
}

}  // namespace stackabilization::detail
