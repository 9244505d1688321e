#pragma once

#include "stackabilization/improvement/best_first.h"
#include "stackabilization/improvement/shape_change.h"

namespace stackabilization {

/// Measure of the change of a shape: the objective of refinement, and the order of refined solutions.
enum class ChangeMeasure {
  distortion,    ///< D of Eq. 6: changes of the primitives
  displacement,  ///< root mean square of vertex displacements after the best similarity fit: shape_change.h
  /// Sum of the two. Each is blind to something: D to a bent tube, the displacement to a broken symmetry.
  both,
};

/// Returns the size of a change, dimensionless, >= 0.
double size_of(ChangeMeasure measure, const Distortion& distortion, const ShapeChange& shape);

/// Returns the size of the change of a candidate from `rest`. Throws UsageError unless the candidate has the
/// triangles of `rest`.
double size_of(ChangeMeasure measure, const Candidate& candidate, const Shape& rest);

}  // namespace stackabilization
