#pragma once

#include <vector>

#include "stackabilization/core/shape.h"

namespace stackabilization {

/// Returns every part of a shape as `extract_part` does, in order, in one pass over the triangles.
std::vector<Shape> extract_parts(const Shape& shape);

}  // namespace stackabilization
