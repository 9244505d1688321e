#pragma once

#include "stackabilization/rendering/scene.h"
#include "stackabilization/structure/structure.h"

// Scenes that show the structure of a shape.
namespace stackabilization {

namespace structure_colour {
inline constexpr Colour point_joint{0.10, 0.66, 0.22};
inline constexpr Colour line_joint = palette::contact;
inline constexpr Colour symmetry{0.45, 0.62, 0.88};
inline constexpr Colour ghost{0.90, 0.90, 0.88};  ///< a shape behind its primitives
}  // namespace structure_colour

/// Returns the parts, with symmetric parts in one colour and frames for the first symmetries of the whole
/// shape.
Scene parts_scene(const StructuredShape& structured);

/// Returns the cuboids and the circles of generalized cylinders in the colours of the parts, point joints as
/// green balls and line joints as red bars, as in Fig. 7 of the paper.
Scene primitives_scene(const StructuredShape& structured);

}  // namespace stackabilization
