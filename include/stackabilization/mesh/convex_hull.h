#pragma once

#include "stackabilization/core/shape.h"

namespace stackabilization {

/// Triangulated boundary of a convex hull.
struct TriangulatedHull {
  int dimension = 0;  ///< of the points' affine span, exact: 0 one point, 1 a segment, 2 a polygon, 3 a body
  Points points;      ///< k x 3 corners, lexicographic order
  /// Each with its smallest corner first, lexicographic order. A body's are all seen counter-clockwise from
  /// outside, a polygon's from one of its sides; a segment and a point have none.
  Triangles triangles;
};

/// Convex hull with exact predicates (CGAL, quickhull in space). Precondition: at least one point, all
/// finite; any of them may coincide or lie on a line or in a plane. Its points are the corners of the hull,
/// none between them; a facet with more than three is a fan from the first of them. Depends on the points
/// alone, not on their order.
TriangulatedHull triangulated_hull(const Points& points);

}  // namespace stackabilization
