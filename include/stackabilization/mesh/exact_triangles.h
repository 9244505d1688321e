#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <vector>

#include "stackabilization/core/shape.h"

namespace stackabilization {

/// Whether three points lie on a line (or coincide). Exact.
bool are_collinear(const Eigen::Vector3d& a, const Eigen::Vector3d& b, const Eigen::Vector3d& c);

/// Rows of the triangles whose corners do not lie on a line, ascending. Exact.
std::vector<std::int32_t> triangles_with_area(const Shape& shape);

/// Number of pairs of triangles (rows of `points`) that meet elsewhere than in the corners and edges
/// they share: they cross, touch, or overlap in a plane. Exact. Pairs with a degenerate triangle and pairs
/// with the same three corners are not counted. Precondition: `points` are pairwise different. Cost: O(m
/// log^2 m + pairs of boxes that meet), where triangles with the same three corners have one box.
std::int64_t count_self_intersections(const Points& points, const Triangles& triangles);

}  // namespace stackabilization
