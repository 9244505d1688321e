#pragma once

#include "stackabilization/envelope/height_field.h"
#include "stackabilization/rendering/scene.h"

namespace stackabilization {

/// The part of a shape's surface that is seen along r from above (`upper`) or from below (`lower`), as
/// triangles with the parts they came from: a picture of an envelope without its vertical jumps. `field` must
/// be of the same shape; occlusion is decided at its samples, and triangles are cut to about a pixel where
/// they pass behind others. Without triangles when nothing is seen at any sample.
Shape envelope_sheet(const Shape& shape, const HeightField& field, EnvelopeSide side);

}  // namespace stackabilization
