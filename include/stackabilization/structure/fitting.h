#pragma once

#include <optional>

#include "stackabilization/structure/structure.h"

namespace stackabilization {

/// The two kinds of Primitive: Cuboid and GeneralizedCylinder.
enum class PrimitiveKind { cuboid, cylinder };

/// Options of `fit_primitive`.
struct FitOptions {
  std::optional<PrimitiveKind> kind;  ///< forced; nothing: the better fit wins
  int sections = 24;                  ///< cross-sections of a generalized cylinder, >= 4
};

/// What `fit_primitive` found.
struct FittedPrimitive {
  Primitive primitive;  ///< of the kind that won or was forced, model units
  PrimitiveFit fit;     ///< errors of both kinds
};
/// The primitive that holds a part, with the errors of both kinds. An error is the two-sided distance of the
/// surfaces of part and primitive, the end discs of a cylinder included: root mean square over both by area,
/// as a fraction of the diagonal of the part's oriented box. The inner wall of a hollow body (a cup) and its
/// mouth count alike for both kinds, so they do not tip the choice.
///
/// * Cuboid: the minimal oriented box; where others are as good to the eye, the one best aligned with
///   the file's axes or the part's own, so that round and square parts of a model get boxes alike. Its
///   axes are in the order and signs that lie nearest to the file's. A box thinner than
///   tolerance::min_thickness is thickened to it.
/// * Generalized cylinder of a body of revolution, hollow or not: along its axis, radii those of its
///   outermost points; or, of a ring, around it, closed.
/// * Of any other part: a straight axis of the box or line through the middle of its outlines, radii
///   the mean distance of the outline from it; or, where box and line hold the part badly and the curve
///   does so clearly better, its mean curvature flow skeleton (Tagliasacchi et al. 2012): the longest
///   path in it, extended to the ends of the part, or its closed loop, unless it branches; radii are
///   mean distances from the curve to the surface. A part that is open, not manifold, of several shells
///   or of very many triangles is wrapped for that (Portaneri et al. 2022).
///
/// The better fit wins, a cylinder when its error is less than 0.85 of the cuboid's. The note tells which
/// curve a cylinder follows and what was done to the part for it. The result is a function of the part alone,
/// and moves with it except where the file's axes decide. Radii are at least a hundredth of the largest.
///
/// Throws InputError when the part has no triangle of positive area, and UsageError for fewer than 4 sections
/// and when a cylinder is demanded of a flat part: one without extent across some plane.
FittedPrimitive fit_primitive(const Shape& part, const FitOptions& options = {});

}  // namespace stackabilization
