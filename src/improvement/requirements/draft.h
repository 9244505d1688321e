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
/// Which triangle counts, per contact polygon:
///
/// | contact | angle |
/// | --- | --- |
/// | face on face | the smaller of both |
/// | edge or corner on face | that of the face |
/// | edge or corner on edge or corner | the larger of both |
///
/// So legs with steep walls on a level top have 90, and a peg with upright walls in a conical hole has the
/// angle of the hole. Contact polygons without area are treated alike; triangles without area are skipped.
/// Double precision; points within tolerance::relative of the diagonal of an edge count as on the edge.
double contact_draft_degrees(const Shape& shape, const std::vector<ContactRegion>& regions,
                             const Direction& direction);

}  // namespace stackabilization
