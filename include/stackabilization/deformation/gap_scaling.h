#pragma once

#include <memory>

#include "stackabilization/deformation/deformation_model.h"

namespace stackabilization {

/// The naive way to make a shape stack, kept as the baseline that shows why structure matters (paper, Fig.
/// 6): the gap function along `direction` is scaled and the upper envelope kept, so that everything below it
/// is squashed upwards.
///
/// Takes HandleKind::shape and Scale along `direction`, either way. A vertex at height z along it whose
/// column reaches up to the height u goes to u - factor (u - z); factors of several edits multiply. The
/// column is closed: along walls that are parallel to the direction it reaches up to their upper ends, also
/// where these are rounded (within tolerance::rounding of the coordinates). Columns are measured once, at
/// rest.
///
/// f_max of the result is `factor` times that of the rest, up to tolerance::relative of the diagonal, where
/// the triangles resolve the envelope: where the upper envelope is linear over every triangle. Elsewhere it
/// is more: a triangle goes where its corners go, whatever is above its inside. Cutting a shape up beforehand
/// (refined.h) brings it near below slopes, but below a step of the envelope only a vertex just there would
/// help. Vertices that no triangle uses stay, equal ones stay equal.
///
/// Squashing changes the extent along the direction: where this is to be kept, the result is stretched back
/// (vertex_constraints.h), which undoes what was gained. Fixed vertices must lie on the upper envelope.
/// centre() is that of the shape's axis-aligned box. Keeps nothing of `shape`'s storage. Throws InputError
/// when `shape` is invalid.
std::unique_ptr<DeformationModel> gap_scaling(const Shape& shape, const Direction& direction);

}  // namespace stackabilization
