#pragma once

#include "stackabilization/envelope/height_field.h"
#include "stackabilization/rendering/scene.h"

namespace stackabilization {

/// Returns the portion of a surface that is visible along r from above (`upper`) or from below (`lower`), as
/// triangles with their parts: an envelope without its vertical jumps. The samples of `field` decide
/// visibility. Triangles are cut to about a pixel where other triangles occlude them. The result has no
/// triangles when there is no surface at any sample. Precondition: `field` is a height field of the same
/// shape.
Shape envelope_sheet(const Shape& shape, const HeightField& field, EnvelopeSide side);

}  // namespace stackabilization
