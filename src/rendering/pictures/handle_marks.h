#pragma once

#include <vector>

#include "rendering/drawing/plot_parts.h"
#include "stackabilization/deformation/edit.h"
#include "stackabilization/rendering/handle_lines.h"
#include "stackabilization/rendering/scene.h"

/// How edited handles are shown. Private to rendering/.
namespace stackabilization::detail {

/// The shape in one colour; parts that were edited as a whole are red.
Scene edited_scene(const Shape& shape, const Colour& colour, const std::vector<Handle>& handles);

/// `handle_lines` of all of them.
std::vector<Points> lines_of(const std::vector<Handle>& handles, const Shape& shape,
                             const std::vector<Primitive>& primitives);

/// Lines of handles, drawn over the picture of `view` at `place`: many lie inside the surface.
Elements handle_marks(const std::vector<Points>& lines, const View& view, const Rectangle& place);

}  // namespace stackabilization::detail
