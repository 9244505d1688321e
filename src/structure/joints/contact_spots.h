#pragma once

#include <vector>

#include "mesh/hull_spread.h"
#include "structure/model/part_surface.h"

namespace stackabilization::detail {

/// A connected region in which two parts meet.
struct ContactSpot {
  /// Hull of where the surfaces cross, where edges and corners of one lie on the other or nearest to it
  /// (midway between both), and of corners of one inside the other.
  HullSpread region;
  double gap = 0;  ///< least distance between the surfaces, model units; 0 where they touch or cross
};

struct ContactOptions {
  double reach = 0;     ///< surfaces nearer than this meet, model units
  double separate = 0;  ///< regions nearer than this are one, model units
};

/// Every region in which surfaces `a` and `b` meet. All regions are found from edges against triangles,
/// exactly in the sense that nothing is sampled: the result does not depend on how finely the surfaces are
/// cut.
std::vector<ContactSpot> contact_spots(const PartSurface& a, const PartSurface& b,
                                       const ContactOptions& options);

}  // namespace stackabilization::detail
