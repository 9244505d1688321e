#pragma once

#include "stackabilization/shape/shape.h"

namespace stackabilization {

/// Triangulated boundary of a convex hull, all triangles seen counter-clockwise from outside.
struct TriangulatedHull {
  Points points;        ///< k x 3, lexicographic order
  Triangles triangles;  ///< each with its smallest corner first, lexicographic order
};

/// Convex hull with exact predicates (CGAL, quickhull). Precondition: the points are finite and do not lie in
/// a plane. Its points are the corners of the hull, none between them; a facet with more than three is a fan
/// from the first of them. Depends on the points alone, not on their order.
TriangulatedHull triangulated_hull(const Points& points);

}  // namespace stackabilization
