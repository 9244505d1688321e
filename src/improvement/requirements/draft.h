#pragma once

#include <vector>

#include "stackabilization/core/direction.h"
#include "stackabilization/core/shape.h"
#include "stackabilization/envelope/contacts.h"

namespace stackabilization {

/// Returns the draft angle in degrees: the least angle between r and the surfaces on which copies touch. It
/// is 90 for level contacts and without contacts; 0 for walls along r, on which copies jam (in solid
/// semantics such walls slide freely and are no contacts).
///
/// A contact has the surface of detail::ContactNormals. Contact polygons without area are treated alike;
/// triangles without area are skipped. Double precision.
double contact_draft_degrees(const Shape& shape, const std::vector<ContactRegion>& regions,
                             const Direction& direction);

}  // namespace stackabilization
