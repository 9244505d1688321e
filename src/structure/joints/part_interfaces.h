#pragma once

#include <vector>

#include "mesh/principal_extents.h"
#include "structure/model/part_surface.h"

namespace stackabilization::detail {

/// A connected region in which two parts meet.
struct PartInterface {
  /// Hull of where the surfaces cross, where edges and corners of one lie on the other or nearest to it
  /// (midway between both), and of corners of one inside the other.
  PrincipalExtents region;
  double gap = 0;  ///< least distance between the surfaces, model units; 0 where they touch or cross
};

struct InterfaceOptions {
  double reach = 0;     ///< surfaces nearer than this meet, model units
  double separate = 0;  ///< regions nearer than this are one, model units
};

/// Every region in which surfaces `a` and `b` meet. All regions are found from edges against triangles,
/// exactly in the sense that nothing is sampled: the result does not depend on how finely the surfaces are
/// cut.
std::vector<PartInterface> part_interfaces(const PartSurface& a, const PartSurface& b,
                                           const InterfaceOptions& options);

}  // namespace stackabilization::detail
