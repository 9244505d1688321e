#pragma once

#include "stackabilization/core/direction.h"
#include "stackabilization/core/rational.h"
#include "stackabilization/core/shape.h"

namespace stackabilization {

/// Exact span of a shape along r, in units of r, with nearest doubles.
struct Span {
  Rational bottom, top;                                ///< exact, units of r
  double approximate_bottom = 0, approximate_top = 0;  ///< nearest doubles, units of r
};

/// Computes the smallest and the largest p . r / r . r over the points of the triangles. Precondition:
/// `validate(shape)` passes.
Span exact_span(const Shape& shape, const Direction& direction);

}  // namespace stackabilization
