#pragma once

#include "stackabilization/core/shape.h"

namespace stackabilization {

/// The vertices that triangles use, each once, in their order in the shape.
Points used_vertices(const Shape& shape);

}  // namespace stackabilization
