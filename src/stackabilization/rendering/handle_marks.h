#pragma once

#include <vector>

#include "stackabilization/deformation/edit.h"
#include "stackabilization/rendering/plot_parts.h"
#include "stackabilization/rendering/scene.h"
#include "stackabilization/structure/primitive.h"

/// How edited handles are shown. Private to rendering/.
namespace stackabilization::detail {

/// Lines that show a handle, a single point for a corner or a point; empty for parts, which are coloured, and
/// for what is not known here, such as wires.
std::vector<Points> handle_lines(const Handle& handle, const Shape& shape,
                                 const std::vector<Primitive>& primitives);

/// The shape in one colour; parts that were edited as a whole are red.
Scene edited_scene(const Shape& shape, const Colour& colour, const std::vector<Handle>& handles);

/// Those lines, drawn over the picture of `view` at `place`: many lie inside the surface.
Elements handle_marks(const std::vector<Points>& lines, const View& view, const Rectangle& place);

}  // namespace stackabilization::detail
