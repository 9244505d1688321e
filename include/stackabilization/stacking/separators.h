#pragma once

#include "stackabilization/core/direction.h"
#include "stackabilization/core/shape.h"
#include "stackabilization/envelope/separation.h"

namespace stackabilization {

/// What `separators` fills.
struct SeparatorOptions {
  ContactSemantics semantics = ContactSemantics::solid;  ///< semantics of the separation
  double lift = 0;  ///< of the copy above, along r, model units; above f_max
  /// Where the gap is wider than its smallest width by more than this, nothing is filled. Model units, > 0.
  double layer = 0;
};

/// Returns the bodies that fill the gap between a copy and the one above it, where that is narrow: what a
/// printer puts between copies that are printed on top of each other. They lie on the copy below, in the
/// coordinates of the shape, one part per contact region with an area (see contact_regions), largest first;
/// where there are too many pairs of triangles, as Contacts::complete says, they have gaps. Each body
/// consists of closed prisms, one per pair of triangles, which touch. No triangles when the copies pass each
/// other, or when no region has an area. Walls thinner than the layer may be pierced.
///
/// Double precision within tolerance::relative of the diagonal. Throws UsageError when the lift leaves no
/// gap, or the layer is not above 0.
Shape separators(const Shape& shape, const Direction& direction, const SeparatorOptions& options);

}  // namespace stackabilization
