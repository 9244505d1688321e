#pragma once

#include <Eigen/Core>

#include "stackabilization/core/direction.h"
#include "stackabilization/core/rational.h"
#include "stackabilization/core/shape.h"

namespace stackabilization {

/// Largest number of triangles that `minkowski_translation` accepts. Its cost is about quadratic: a few
/// seconds for this number.
inline constexpr Eigen::Index max_minkowski_triangles = 100;

/// Computes f_max(M, r) of a closed solid in `solid` semantics, in units of r, from the Minkowski sum of its
/// interior and its mirrored interior: int M and int M + t r intersect exactly when t r lies in int M + (-int
/// M), so f_max is the supremum of these t. Exact (CGAL Nef polyhedra over rationals). It shares no code with
/// the separation queries.
///
/// The function cuts the solid into convex pieces and intersects the open sums of all pairs of pieces with
/// the line along r. It does not unite the sums. Two interior points that differ by t r can move together off
/// the cuts, so no t is lost. A closed union would fill passages that the solid exactly fits.
///
/// Connected components may overlap; each counts as a solid, whatever its orientation. Cavities count as
/// filled, which does not change f_max. Throws UsageError above `max_minkowski_triangles`. Throws InputError
/// when `validate(solid)` fails, and unless every connected component is a closed, consistently oriented
/// 2-manifold without self-intersections and without triangles of zero area.
///
/// Source: Hachenberger, "Exact Minkowski sums of polyhedra and exact and efficient decomposition of
/// polyhedra into convex pieces", Algorithmica 55 (2009).
Rational minkowski_translation(const Shape& solid, const Direction& direction);

}  // namespace stackabilization
