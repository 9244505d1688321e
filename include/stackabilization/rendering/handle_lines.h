#pragma once

#include <vector>

#include "stackabilization/core/shape.h"
#include "stackabilization/deformation/edit.h"
#include "stackabilization/structure/primitive.h"

namespace stackabilization {

/// Returns lines that show a handle; a corner or a point gives a single point. Empty for parts, which are
/// coloured instead, and for handles without lines, such as wires.
std::vector<Points> handle_lines(const Handle& handle, const Shape& shape,
                                 const std::vector<Primitive>& primitives);

}  // namespace stackabilization
