#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "stackabilization/core/shape.h"

namespace stackabilization {

/// Cuts a polygon of k >= 3 corners (rows of `vertices`) into k - 2 triangles of the polygon's orientation,
/// without new vertices. Decisions are exact, in the coordinate plane that the polygon faces most (Newell's
/// normal): a strictly convex polygon becomes a fan from its first corner, any other is cut by ears (Meisters
/// 1975), so simple polygons never flip, convex or not. Polygons that cross themselves give some
/// triangulation. Cost: O(k) when convex, else O(k (1 + number of reflex corners)).
std::vector<std::array<std::int32_t, 3>> triangulate(const Points& vertices,
                                                     std::span<const std::int32_t> polygon);

}  // namespace stackabilization
