#pragma once

#include "stackabilization/core/shape.h"

namespace stackabilization {

/// Triangulated boundary of a convex hull.
struct TriangulatedHull {
  /// Exact dimension of the affine span of the points: 0 one point, 1 a segment, 2 a polygon, 3 a body.
  int dimension = 0;
  Points points;  ///< k x 3 corners, lexicographic order
  /// Each triangle starts with its smallest corner; triangles are in lexicographic order. Triangles of a body
  /// are counter-clockwise seen from outside, those of a polygon seen from one of its sides. A segment and a
  /// point have none.
  Triangles triangles;
};

/// Computes the convex hull with exact predicates (CGAL, quickhull in space). The points of the result are
/// the corners of the hull only. A facet with more than three corners is a fan from its first corner. The
/// result depends on the set of points, not on their order. Precondition: at least one point, all finite;
/// points may coincide or lie on a line or in a plane.
TriangulatedHull triangulated_hull(const Points& points);

}  // namespace stackabilization
