#pragma once

#include <optional>

#include "stackabilization/core/shape.h"

namespace stackabilization::detail {

/// A closed, connected, outward oriented surface of a few thousand well-shaped triangles that replaces a
/// part.
struct ClosedPart {
  Shape surface;
  /// Whether `surface` is an alpha wrap. The part itself is then open, non-manifold, of several shells
  /// or very large.
  bool wrapped = false;
};

/// Remeshes a closed connected part (Botsch and Kobbelt 2004). Any other part is replaced by its alpha wrap
/// (Portaneri et al. 2022), which is slightly larger than the part; mouths that are narrow for its area, such
/// as those of a handle cut off a cup, get caps before. The cost is bounded for parts of any size. Returns
/// nothing when CGAL fails.
std::optional<ClosedPart> closed_part(const Shape& part);

}  // namespace stackabilization::detail
