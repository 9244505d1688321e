#pragma once

#include "stackabilization/core/shape.h"

namespace stackabilization {

/// Computes the diagonal of the axis-aligned box around the triangles of a shape, model units. It is
/// Structure::diagonal. Precondition: at least one triangle.
double bounding_diagonal(const Shape& shape);

}  // namespace stackabilization
