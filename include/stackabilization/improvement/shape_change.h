#pragma once

#include "stackabilization/core/shape.h"

namespace stackabilization {

/// How far a shape was changed, apart from being moved, turned and scaled.
struct ShapeChange {
  double root_mean_square = 0;  ///< of the vertex distances after the best similarity fit, over the diagonal
  double largest = 0;           ///< the same for the farthest vertex
};

/// Fits `after` to `before` by the similarity (rotation, translation, one factor; no reflection) of least
/// squared distances (Umeyama 1991) over the vertices that triangles use, and measures what is left over the
/// diagonal of the axis-aligned box of `before` (0 where that is 0). Throws UsageError unless both have the
/// same triangles and as many vertices.
ShapeChange shape_change(const Shape& before, const Shape& after);

/// What shape_change measures: where the vertices that triangles use lie after that fit, less where they
/// were, over the diagonal; n x 3, 0 x 3 where the diagonal is 0. Throws as that.
Points displacements(const Shape& before, const Shape& after);

/// Root mean square of the lengths of the rows, 0 for none.
double root_mean_square(const Points& vectors);

}  // namespace stackabilization
