#pragma once

#include <vector>

#include "stackabilization/core/direction.h"
#include "stackabilization/core/shape.h"
#include "stackabilization/envelope/contacts.h"
#include "stacking/statics/contact_forces.h"

namespace stackabilization::detail {

/// A hold of a copy by the one below.
struct ContactHold {
  Hold hold;            ///< on the copy below, model units
  int upper_part = -1;  ///< touched part of the copy below
  int lower_part = -1;  ///< touching part of the copy above
};

/// Returns the corners of contact regions with their normals (ContactNormals). Of points of two parts in one
/// plane the corners of the convex hull are enough: any force at another point is one of theirs. Polygons of
/// triangles without area have none.
std::vector<ContactHold> contact_holds(const Shape& shape, const Direction& direction,
                                       const std::vector<ContactRegion>& regions);

/// Returns the holds that are most different from each other in place and normal, at most `count`: first the
/// first one, then always the one farthest from those before, a turn of the normal by 1 radian counting as
/// the diagonal of their box. A body that these hold is held by all.
std::vector<ContactHold> spread_out(const std::vector<ContactHold>& contacts, std::size_t count);

/// Returns holds in the coordinates of a frame.
std::vector<Hold> holds_in(const Frame& frame, const std::vector<ContactHold>& contacts);

/// Number of holds with which forces are computed: around a rim, one every four degrees.
inline constexpr std::size_t hold_count = 96;

}  // namespace stackabilization::detail
