#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "stackabilization/core/shape.h"

namespace stackabilization {

/// Cuts a polygon of k >= 3 corners (rows of `vertices`) into k - 2 triangles of the same orientation,
/// without new vertices. Predicates are exact and evaluated in the coordinate plane that is most parallel to
/// the polygon (Newell's normal). A strictly convex polygon becomes a fan from its first corner. Any other
/// polygon is cut by ear clipping (Meisters 1975), so the triangles of a simple polygon are never reversed. A
/// self-intersecting polygon gives an arbitrary triangulation. Cost: O(k) for convex polygons, otherwise O(k
/// (1 + number of reflex corners)).
std::vector<std::array<std::int32_t, 3>> triangulate(const Points& vertices,
                                                     std::span<const std::int32_t> polygon);

}  // namespace stackabilization
