#pragma once

#include "stackabilization/shape/shape.h"

namespace stackabilization {

/// Triangulated boundary of a convex hull, all triangles seen counter-clockwise from outside.
struct TriangulatedHull {
  Points points;  ///< k x 3, lexicographic order
  Triangles triangles;
};

/// Convex hull with exact predicates (CGAL, quickhull). Precondition: the points are finite and do not lie in
/// a plane. Depends on the order of the points only where the hull is not simplicial.
TriangulatedHull triangulated_hull(const Points& points);

}  // namespace stackabilization
