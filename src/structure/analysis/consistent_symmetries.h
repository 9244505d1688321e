#pragma once

#include "stackabilization/structure/structure.h"

namespace stackabilization::detail {

/// Returns the difference of two symmetries of `primitive`, model units: the larger of two values. The first
/// is the largest distance between the images of the control points. The second is the difference of the
/// rotations. (The control points of a straight curve alone do not distinguish planes through the curve.)
double difference(const Symmetry& a, const Symmetry& b, const Primitive& primitive);

/// Makes the symmetries of `structure` consistent, so that their products generate finite groups in double
/// precision:
///
/// * The symmetry of a relation becomes a symmetry of the whole shape, or of an earlier relation, when both
///   map the control points of its part to the same places within tolerance::same_symmetry.
/// * Axes and normals within tolerance::file_axis of being orthogonal to an axis of the file become exactly
///   orthogonal to it.
/// * Mirror planes of the same parts that meet within tolerance::same_symmetry (radians) of 90 degrees, or of
///   another multiple of 180 / n degrees with n up to 8, meet at exactly that angle. Rotation axes lie
///   exactly in these planes or orthogonal to them. Three planes that nearly share a line share it exactly.
///
/// Symmetries with larger differences stay unchanged.
void make_consistent(Structure& structure);

}  // namespace stackabilization::detail
