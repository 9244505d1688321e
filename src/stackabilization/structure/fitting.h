#pragma once

#include <optional>

#include "stackabilization/structure/structure.h"

namespace stackabilization {

enum class PrimitiveKind { cuboid, cylinder };

struct FitOptions {
  std::optional<PrimitiveKind> kind;  ///< forced; nothing: the better fit wins
  int sections = 24;                  ///< cross-sections of a generalized cylinder, >= 4
};

/// The primitive that holds a part, with the errors of both kinds. Both errors are the root mean square distance,
/// over the part's surface by area, from the surface to the primitive's surface, so that they can be compared; of a
/// hollow body (a cup) the outside alone counts.
///
/// * Cuboid: the minimal oriented box.
/// * Generalized cylinder: axis of a body of revolution where the part is one; else its mean curvature flow skeleton
///   (Tagliasacchi et al. 2012), the longest path or the closed loop of it, extended to the ends of the part; else the
///   straight axis of the box. Radii are distances from the curve to the surface.
///
/// Works on open, non-manifold and several-shelled parts; what had to be wrapped or repaired for the skeleton is told
/// in the note. Throws InputError when the part has no triangle of positive area, and UsageError when a cylinder is
/// demanded of a part that has none (flat: no extent across any axis).
struct FittedPrimitive {
  Primitive primitive;
  PrimitiveFit fit;
};
FittedPrimitive fit_primitive(const Shape& part, const FitOptions& options = {});

}  // namespace stackabilization
