#pragma once

#include <vector>

#include "stackabilization/core/shape.h"
#include "stackabilization/deformation/edit.h"
#include "stackabilization/structure/primitive.h"

namespace stackabilization {

/// Lines that show a handle, a single point for a corner or a point; empty for parts, which are coloured, and
/// for what is not known here, such as wires.
std::vector<Points> handle_lines(const Handle& handle, const Shape& shape,
                                 const std::vector<Primitive>& primitives);

}  // namespace stackabilization
