#pragma once

#include "stackabilization/improvement/design.h"

namespace stackabilization {

/// How far a part is from the size it has at rest.
struct Proportion {
  double ratio = 1;  ///< in (0, 1]: of two sizes, at rest and now, the smaller over the larger
  int part = -1;     ///< the part with the least ratio; -1: nothing changed its size
};

/// The least ratio over all parts: of the three sides of a cuboid (means of four edges, but for thicknesses
/// that a flat box lacks), of the radii and the arc length of a generalized cylinder. What is stretched
/// counts as what is shrunk. Single edges of a cuboid count where they shrink; a slanting one is longer.
/// Energies weigh parts by their volume and let thin ones wither; this does not.
Proportion least_proportion(const StructuredShape& rest, const Design& design);

}  // namespace stackabilization
