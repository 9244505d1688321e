#pragma once

#include <vector>

#include "rendering/drawing/plot_parts.h"
#include "stackabilization/deformation/edit.h"
#include "stackabilization/rendering/handle_lines.h"
#include "stackabilization/rendering/scene.h"

/// Marks of edited handles in pictures.
namespace stackabilization::detail {

/// Returns the shape in one colour, with red parts where a part was edited as a whole.
Scene edited_scene(const Shape& shape, const Colour& colour, const std::vector<Handle>& handles);

/// Returns the `handle_lines` of all handles.
std::vector<Points> lines_of(const std::vector<Handle>& handles, const Shape& shape,
                             const std::vector<Primitive>& primitives);

/// Draws lines of handles over the picture of `view` at `place`, since many of them lie inside the surface.
Elements handle_marks(const std::vector<Points>& lines, const View& view, const Rectangle& place);

}  // namespace stackabilization::detail
