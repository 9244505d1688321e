#pragma once

#include "stackabilization/core/shape.h"

namespace stackabilization {

/// Returns the vertices that triangles use, each once, in the order of the shape.
Points used_vertices(const Shape& shape);

}  // namespace stackabilization
