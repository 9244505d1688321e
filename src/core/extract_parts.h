#pragma once

#include <vector>

#include "stackabilization/core/shape.h"

namespace stackabilization {

/// Every part of a shape as `extract_part` gives it, in order, in one pass over the triangles.
std::vector<Shape> extract_parts(const Shape& shape);

}  // namespace stackabilization
