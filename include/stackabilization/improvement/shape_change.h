#pragma once

#include "stackabilization/core/shape.h"

namespace stackabilization {

/// Change of a shape, up to a similarity.
struct ShapeChange {
  /// Root mean square of the vertex displacements after the best similarity fit, over the diagonal.
  double root_mean_square = 0;
  double largest = 0;  ///< largest displacement, over the diagonal
};

/// Fits `after` to `before` by the similarity (rotation, translation, one factor; no reflection) of least
/// squared distances (Umeyama 1991) over the vertices that triangles use. Returns the remaining displacements
/// over the diagonal of the axis-aligned box of `before`; 0 where the diagonal is 0. Throws UsageError unless
/// both shapes have the same triangles and the same number of vertices.
ShapeChange shape_change(const Shape& before, const Shape& after);

/// Returns the displacements that `shape_change` measures: positions after the fit minus positions in
/// `before`, of the vertices that triangles use, over the diagonal; n x 3, or 0 x 3 where the diagonal is 0.
/// Throws as `shape_change`.
Points displacements(const Shape& before, const Shape& after);

/// Returns the root mean square of the lengths of the rows; 0 without rows.
double root_mean_square(const Points& vectors);

}  // namespace stackabilization
