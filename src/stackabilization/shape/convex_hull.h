#pragma once

#include "stackabilization/shape/shape.h"

namespace stackabilization {

/// Triangulated boundary of a convex hull, all triangles seen counter-clockwise from outside.
struct TriangulatedHull {
  Points points;        ///< k x 3, lexicographic order
  Triangles triangles;  ///< each with its smallest corner first, lexicographic order
};

/// Convex hull with exact predicates (CGAL, quickhull). Precondition: the points are finite and do not lie in
/// a plane. Where more than three points lie in the plane of a face, how it is cut into triangles is
/// arbitrary, and may differ from run to run.
TriangulatedHull triangulated_hull(const Points& points);

}  // namespace stackabilization
