#pragma once

#include <optional>

#include "stackabilization/structure/structure.h"

namespace stackabilization {

/// Kind of a Primitive: Cuboid or GeneralizedCylinder.
enum class PrimitiveKind { cuboid, cylinder };

/// Options of `fit_primitive`.
struct FitOptions {
  std::optional<PrimitiveKind> kind;  ///< forced kind; empty: the kind with the better fit
  int sections = 24;                  ///< number of cross-sections of a generalized cylinder, >= 4
};

/// Result of `fit_primitive`.
struct FittedPrimitive {
  Primitive primitive;  ///< the better or the forced kind, model units
  PrimitiveFit fit;     ///< errors of both kinds
};

/// Fits a primitive to a part and reports the errors of both kinds. The error is the two-sided distance
/// between the surfaces of part and primitive, including the end discs of a cylinder: the root mean square
/// over both areas, as a fraction of the diagonal of the oriented box of the part. The inner wall and the
/// mouth of a hollow body, such as a cup, add the same error to both kinds and therefore do not influence the
/// choice.
///
/// * Cuboid: the minimal oriented box. Where other boxes fit nearly as well, the function takes the box that
///   is best aligned with the axes of the file or of the part, so that round and square parts of a model get
///   consistent boxes. The order and the signs of the box axes are the nearest ones to the file's axes. A box
///   thinner than tolerance::min_thickness is thickened to it.
/// * Generalized cylinder of a body of revolution, hollow or not: the curve is the axis, and the radii are
///   those of the outermost points. For a ring, the curve is closed and runs around the axis.
/// * Generalized cylinder of any other part: the curve is a straight line, either an axis of the box or the
///   line through the middles of the outlines, and the radii are the mean distances of the outline from it.
///   Where box and line fit badly and a curved axis fits clearly better, the curve is the mean curvature flow
///   skeleton (Tagliasacchi et al. 2012): its longest path, extended to the ends of the part, or its closed
///   loop. A branching skeleton is not used. The radii are then the mean distances from the curve to the
///   surface. The skeleton of a part that is open, non-manifold, of several shells or of very many triangles
///   is computed on an alpha wrap (Portaneri et al. 2022).
///
/// The cylinder is chosen when its error is less than 0.85 of the cuboid's error, otherwise the cuboid.
/// PrimitiveFit::note names the curve of the cylinder and the preparation of the part. The result depends on
/// the part alone. It moves with the part, except where the file's axes decide. Every radius is at least a
/// hundredth of the largest one.
///
/// Throws InputError when the part has no triangle of positive area. Throws UsageError for fewer than 4
/// sections, and for a forced cylinder on a flat part. A flat part has no extent across some plane.
FittedPrimitive fit_primitive(const Shape& part, const FitOptions& options = {});

}  // namespace stackabilization
