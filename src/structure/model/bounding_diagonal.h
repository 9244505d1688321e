#pragma once

#include "stackabilization/core/shape.h"

namespace stackabilization {

/// Diagonal of the axis-aligned box around the triangles of a shape, model units: Structure::diagonal.
/// Precondition: at least one triangle.
double bounding_diagonal(const Shape& shape);

}  // namespace stackabilization
