#pragma once

#include <memory>

#include "stackabilization/deformation/carried_model.h"

namespace stackabilization {

/// Creates the deformation model that scales the gap function along `direction` and keeps the upper envelope:
/// it squashes everything below the envelope upwards. It is the naive way to make a shape stack, and serves
/// as the baseline that shows why structure matters (paper, Fig. 6).
///
/// The model accepts HandleKind::shape and Scale along `direction`, in either sense. A vertex at height z
/// along the direction, in a column of the shape that reaches up to height u, moves to height u - factor (u -
/// z). The factors of several edits multiply. Columns are closed: on a wall parallel to the direction the
/// column reaches the upper end of the wall, also when the coordinates of the wall are rounded (within
/// tolerance::rounding of the coordinates). The model measures the columns once, at rest.
///
/// f_max of the result is `factor` times f_max at rest, up to tolerance::relative of the diagonal, when the
/// triangles resolve the envelope, that is, when the upper envelope is linear over every triangle. Otherwise
/// f_max is larger: a triangle follows its corners, whatever lies above its interior. Subdivision beforehand
/// (refined.h) brings f_max close to this value below slopes. Below a step of the envelope only a vertex
/// exactly at the step would help. Vertices that no triangle uses do not move. Vertices of equal coordinates
/// stay equal.
///
/// Squashing changes the extent along the direction. When the extent must be kept, the model stretches the
/// result back (vertex_constraints.h), which undoes the gain. Fixed vertices must lie on the upper envelope.
/// centre() returns the centre of the shape's axis-aligned box. The structure of `rest` is carried along
/// (carried_model.h); it may be that of `unstructured`. Throws InputError when the shape is invalid.
std::unique_ptr<DeformationModel> gap_scaling(StructuredShape rest, const Direction& direction);

}  // namespace stackabilization
