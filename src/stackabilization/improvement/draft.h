#pragma once

#include <vector>

#include "stackabilization/envelope/contacts.h"
#include "stackabilization/shape/direction.h"
#include "stackabilization/shape/shape.h"

namespace stackabilization {

/// Least angle between r and the surfaces of both copies where they touch, degrees in [0, 90]: 90 for level
/// contacts, 0 for walls along r, on which copies jam. Contact polygons without area count by their
/// triangles; 90 when there are none.
double contact_draft_degrees(const Shape& shape, const std::vector<ContactRegion>& regions,
                             const Direction& direction);

}  // namespace stackabilization
