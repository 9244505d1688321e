#pragma once

#include "stackabilization/improvement/best_first.h"
#include "stackabilization/improvement/shape_change.h"

namespace stackabilization {

/// What refinement makes small, and refined solutions are ordered by.
enum class ChangeMeasure {
  distortion,    ///< D of Eq. 6: what the primitives lose
  displacement,  ///< root mean square distance of the vertices after the best similarity fit, see
                 ///< shape_change
  both,          ///< their sum: neither sees everything (D no bend of a tube, the other no symmetry)
};

/// The size of a change, without unit and at least 0.
double size_of(ChangeMeasure measure, const Distortion& distortion, const ShapeChange& shape);

/// That of a candidate. Throws UsageError unless it has the triangles of `rest`.
double size_of(ChangeMeasure measure, const Candidate& candidate, const Shape& rest);

}  // namespace stackabilization
