#pragma once

#include <optional>

#include "stackabilization/core/shape.h"

namespace stackabilization::detail {

/// A closed, connected, outward oriented surface of some thousand even triangles that stands for a part.
struct ClosedPart {
  Shape surface;
  bool wrapped =
      false;  ///< the part itself is open, not manifold, of several shells or very large: this wraps it
};

/// The part itself remeshed (Botsch and Kobbelt 2004) where it is closed and connected, else its alpha wrap
/// (Portaneri et al. 2022), a little larger than the part. The work is bounded for parts of any size. Nothing
/// when CGAL fails.
std::optional<ClosedPart> closed_part(const Shape& part);

}  // namespace stackabilization::detail
