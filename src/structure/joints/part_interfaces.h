#pragma once

#include <vector>

#include "mesh/principal_extents.h"
#include "structure/model/part_surface.h"

namespace stackabilization::detail {

/// A connected region in which two parts of one copy meet.
struct PartInterface {
  /// Convex hull of the meeting points. These are the crossings of the surfaces, the points of edges and
  /// corners of one surface on or nearest to the other (midway between both), and the corners of one part
  /// inside the other.
  PrincipalExtents region;
  double gap = 0;  ///< smallest distance between the surfaces, model units; 0 where they touch or cross
};

/// Thresholds of `part_interfaces`.
struct InterfaceOptions {
  double reach = 0;     ///< largest distance between surfaces that meet, model units
  double separate = 0;  ///< regions nearer to each other than this are one, model units
};

/// Finds all regions in which surfaces `a` and `b` meet. The regions are computed from edges against
/// triangles, without sampling. The tessellation of the surfaces does not influence them.
std::vector<PartInterface> part_interfaces(const PartSurface& a, const PartSurface& b,
                                           const InterfaceOptions& options);

}  // namespace stackabilization::detail
