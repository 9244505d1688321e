#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <utility>
#include <vector>

#include "stackabilization/core/shape.h"

namespace stackabilization {

/// Returns whether three points lie on a line or coincide. Exact.
bool are_collinear(const Eigen::Vector3d& a, const Eigen::Vector3d& b, const Eigen::Vector3d& c);

/// Returns the rows of the triangles whose corners do not lie on a line, ascending. Exact.
std::vector<std::int32_t> triangles_with_area(const Shape& shape);

/// Counts the pairs of triangles (rows of `points`) that intersect outside their common corners and edges:
/// they cross, touch or overlap in a plane. Exact. Pairs with a degenerate triangle and pairs with the same
/// three corners do not count. Precondition: `points` are pairwise different. Cost: O(m log^2 m + pairs of
/// intersecting boxes); triangles with the same three corners have one box.
std::int64_t count_self_intersections(const Points& points, const Triangles& triangles);

/// Returns those pairs of rows of `triangles`, the smaller row first, ascending. Same conditions and cost.
std::vector<std::pair<std::int32_t, std::int32_t>> self_intersections(const Points& points,
                                                                      const Triangles& triangles);

}  // namespace stackabilization
