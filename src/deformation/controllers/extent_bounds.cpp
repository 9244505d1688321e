#include "deformation/controllers/extent_bounds.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "stackabilization/core/errors.h"
#include "stackabilization/core/tolerances.h"

namespace stackabilization::detail {

std::vector<ExtentBound> extent_bounds(const Shape& rest, const DeformationConstraints& constraints) {
  std::vector<ExtentBound> bounds;
  const auto bound = [&](const Eigen::Vector3d& normal, double slack) {
    const double extent = range_along(rest, normal).length();
    bounds.push_back({normal, (1 - slack) * extent, (1 + slack) * extent, std::nullopt});
  };
  if (constraints.keep_extent) {
    bound(constraints.keep_extent->unit(), 0);
    if (constraints.extent_ends == ExtentEnds::fixed)
      bounds.back().level = range_along(rest, bounds.back().normal).low;
  }
  if (constraints.box_tolerance) {
    if (!std::isfinite(*constraints.box_tolerance) || *constraints.box_tolerance < 0)
      throw UsageError("the tolerance of the box must be 0 or positive");
    for (int axis = 0; axis < 3; ++axis) bound(Eigen::Vector3d::Unit(axis), *constraints.box_tolerance);
  }
  return bounds;
}

std::vector<std::vector<int>> vertices_by_part(const Shape& shape) {
  std::vector<std::vector<int>> by_part(static_cast<std::size_t>(shape.part_count()));
  for (Eigen::Index t = 0; t < shape.triangle_count(); ++t)
    for (int k = 0; k < 3; ++k)
      by_part[static_cast<std::size_t>(shape.triangle_part[static_cast<std::size_t>(t)])].push_back(
          shape.triangles(t, k));
  for (std::vector<int>& vertices : by_part) {
    std::sort(vertices.begin(), vertices.end());
    vertices.erase(std::unique(vertices.begin(), vertices.end()), vertices.end());
  }
  return by_part;
}

std::vector<std::vector<int>> vertices_by_class(const Shape& shape, const Rig& rig) {
  const std::vector<std::vector<int>> by_part = vertices_by_part(shape);
  std::vector<std::vector<int>> by_class;
  for (int c = 0; c < rig.space.class_count(); ++c) {
    std::set<int> vertices;
    for (const int part : rig.space.members(c)) {
      const std::vector<int>& own = by_part[static_cast<std::size_t>(part)];
      vertices.insert(own.begin(), own.end());
    }
    by_class.emplace_back(vertices.begin(), vertices.end());
  }
  return by_class;
}

Range ActiveExtentConstraints::range(std::size_t k, const Points& vertices) const {
  const Eigen::Vector3d& normal = bounds_[k].normal;
  Range range{std::numeric_limits<double>::infinity(), -std::numeric_limits<double>::infinity()};
  for (const std::vector<int>& group : groups_)
    for (const int v : group) {
      const double height = vertices.row(v).dot(normal);
      range.low = std::min(range.low, height);
      range.high = std::max(range.high, height);
    }
  return range;
}

Range ActiveExtentConstraints::wanted(std::size_t k, const Points& vertices) const {
  const double low = bounds_[k].level.value_or(range(k, vertices).low);
  return {low, low + bounds_[k].high};
}

double ActiveExtentConstraints::excess(std::size_t k, const Points& vertices) const {
  const Range now = range(k, vertices);
  const double length = now.length(), slack = tolerance::relative / 2 * length;
  if (const std::optional<double> level = bounds_[k].level) {
    const double below = *level - now.low, above = now.high - (*level + bounds_[k].high);
    const double farthest = std::abs(below) > std::abs(above) ? below : above;
    return std::abs(farthest) > slack ? farthest : 0;
  }
  if (length > bounds_[k].high + slack) return length - bounds_[k].high;
  if (length < bounds_[k].low - slack) return length - bounds_[k].low;
  return 0;
}

bool ActiveExtentConstraints::any_excess(const Points& vertices) const {
  for (std::size_t k = 0; k < bounds_.size(); ++k)
    if (excess(k, vertices) != 0) return true;
  return false;
}

Eigen::VectorXd ActiveExtentConstraints::levels(const Points& vertices) const {
  Eigen::VectorXd levels(static_cast<Eigen::Index>(bounds_.size()));
  for (std::size_t k = 0; k < bounds_.size(); ++k)
    levels(static_cast<Eigen::Index>(k)) = range(k, vertices).low;
  return levels;
}

bool ActiveExtentConstraints::hold(std::size_t k, const Points& vertices, OnExchange on_exchange) {
  const bool above = hold_side(k, true, vertices, on_exchange);
  const bool below = hold_side(k, false, vertices, on_exchange);
  return above || below;
}

bool ActiveExtentConstraints::hold_side(std::size_t k, bool upper, const Points& vertices,
                                        OnExchange on_exchange) {
  const ExtentBound& bound = bounds_[k];
  const double sign = upper ? 1 : -1, beyond = excess(k, vertices);
  const Range whole = range(k, vertices);
  const double extreme = upper ? whole.high : -whole.low;
  const double end = bound.level ? sign * *bound.level + (upper ? bound.high : 0) : 0;
  const double outermost = bound.level ? std::min(extreme, end) : extreme - std::max(beyond, 0.0);
  // Vertices of equal height up to rounding count as equally high. The choice of the held vertices determines
  // the result of a solve, so it must change only with the edit.
  const double slack = tolerance::relative * whole.length();
  bool added = false;
  for (std::size_t g = 0; g < groups_.size(); ++g) {
    const auto height = [&](int v) { return sign * vertices.row(v).dot(bound.normal); };
    double highest = -std::numeric_limits<double>::infinity();
    for (const int v : groups_[g]) highest = std::max(highest, height(v));
    if (!(highest >= outermost - slack)) continue;
    const int top = *std::find_if(groups_[g].begin(), groups_[g].end(),
                                  [&](int v) { return height(v) >= highest - slack; });
    Held& held = held_[{k, upper, g}];
    if (on_exchange == OnExchange::release) held.vertices.clear();
    const bool joins = held.vertices.insert(top).second, first = held.ever.insert(top).second;
    added |= on_exchange == OnExchange::release ? first : joins;
    held.height = bound.level ? sign * end : upper ? (beyond > 0 ? bound.high : bound.low) : 0;
  }
  return added;
}

std::vector<Constraint> ActiveExtentConstraints::constraints(const MeshTransfer& transfer) const {
  std::vector<Constraint> constraints;
  for (const auto& [where, held] : held_)
    for (const int vertex : held.vertices) {
      const std::size_t k = std::get<0>(where);
      Constraint constraint;
      constraint.bound_points = transfer.bound_points(vertex);
      constraint.normal = bounds_[k].normal;
      constraint.height = held.height;
      if (!bounds_[k].level) constraint.level = static_cast<int>(k);
      constraints.push_back(std::move(constraint));
    }
  return constraints;
}

void ActiveExtentConstraints::release() {
  held_.clear();
}

}  // namespace stackabilization::detail
