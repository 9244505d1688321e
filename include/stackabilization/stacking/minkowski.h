#pragma once

#include <Eigen/Core>

#include "stackabilization/core/direction.h"
#include "stackabilization/core/rational.h"
#include "stackabilization/core/shape.h"

namespace stackabilization {

/// Largest triangle count that `minkowski_translation` accepts: the sum takes about a quadratic time, and a
/// few seconds here.
inline constexpr Eigen::Index max_minkowski_triangles = 100;

/// f_max(M, r) of a closed solid in `solid` semantics, in units of r, from the Minkowski sum of its interior
/// with the mirrored one: int M and int M + t r meet exactly when t r lies in int M + (-int M), so f_max is
/// the supremum of those t. Exact (CGAL Nef polyhedra over rationals) and sharing nothing with the separation
/// code.
///
/// The solid is cut into convex pieces and the open sums of all pairs of pieces are intersected with the line
/// along r. They are not united: two interior points that differ by t r can be moved together off the cuts,
/// so no t is lost, and a closed union would fill passages that the solid just fits into.
///
/// Connected components may overlap and are taken as solids whichever way they are oriented; cavities count
/// as filled, which does not change f_max. Throws UsageError above `max_minkowski_triangles`; InputError
/// unless every connected component is a closed, consistently oriented 2-manifold without triangles without
/// area and without self-intersections, or when `validate(solid)` fails.
///
/// Source: Hachenberger, "Exact Minkowski sums of polyhedra and exact and efficient decomposition of
/// polyhedra into convex pieces", Algorithmica 55 (2009).
Rational minkowski_translation(const Shape& solid, const Direction& direction);

}  // namespace stackabilization
