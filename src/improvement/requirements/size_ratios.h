#pragma once

#include "stackabilization/deformation/deformation_model.h"

namespace stackabilization {

/// Change of the sizes of a part against rest.
struct SizeRatio {
  double ratio = 1;  ///< in (0, 1]: of a size at rest and now, the smaller over the larger
  int part = -1;     ///< the part of least ratio; -1: no size changed
};

/// Returns the least ratio of sizes over all parts. Sizes are the three sides of a cuboid (means of four
/// edges; flat boxes without their thickness), the radii and the arc length of a generalized cylinder.
/// Stretching counts like shrinking. Single edges of a cuboid count only where they shrink, since a slanting
/// edge is longer. Complements the energies, which weigh parts by volume and would let thin parts wither.
SizeRatio min_size_ratio(const StructuredShape& rest, const Design& design);

}  // namespace stackabilization
