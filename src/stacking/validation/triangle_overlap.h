#pragma once

#include "stacking/validation/exact_body.h"

namespace stackabilization::detail {

/// Returns whether two triangles that touch, row `in_a` of `a` and row `in_b` of `b`, and their neighbours
/// alone prove that the interiors of the two solids overlap. Exact. Precondition: both surfaces are closed.
bool overlap_near(const Placed& a, std::int32_t in_a, const Placed& b, std::int32_t in_b);

/// Returns whether the relative interior of t, which the surface of the solid does not cross, runs inside the
/// solid. Exact.
bool is_inside(const Corners& t, const SolidLocator& solid);

}  // namespace stackabilization::detail
