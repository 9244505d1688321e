#pragma once

#include <vector>

#include "stackabilization/core/direction.h"
#include "stackabilization/core/shape.h"
#include "stackabilization/envelope/contacts.h"

namespace stackabilization {

/// Least angle between r and the surfaces with which copies press on each other, degrees in [0, 90]: 90 for
/// level contacts, 0 for walls along r, on which copies jam (in solid semantics these slide freely, and there
/// are no contacts with them).
///
/// Where two faces touch, both count; where an edge or a corner rests on a face, only that face does: legs
/// with steep walls that stand on a level top have 90, a peg with upright walls in a conical hole has the
/// angle of the hole. Where edges meet edges the flatter one of the two triangles counts. Contact polygons
/// without area are judged in the same way; triangles without area are passed over. 90 when there are none.
/// Double precision; corners within tolerance::relative of the diagonal of an edge count as on it.
double contact_draft_degrees(const Shape& shape, const std::vector<ContactRegion>& regions,
                             const Direction& direction);

}  // namespace stackabilization
