#pragma once

#include "stackabilization/structure/structure.h"

namespace stackabilization::detail {

/// Largest distance between where two symmetries take the control points of `primitive`, and how far they
/// turn it differently, model units. (The control points of a straight curve alone do not tell planes through
/// it apart.)
double difference(const Symmetry& a, const Symmetry& b, const Primitive& primitive);

/// Makes the symmetries of `structure` fit together, so that their products close into finite groups in
/// double precision:
///
/// * a relation whose symmetry takes the control points of its part within tolerance::same_symmetry of where
/// a global
///   symmetry, or that of an earlier relation, does to it, gets that one;
/// * axes and normals within tolerance::file_axis of being orthogonal to an axis of the file are so exactly;
/// * mirror planes that bear on the same parts and meet within tolerance::same_symmetry (radians) of 90
/// degrees, or of
///   another multiple of 180 / n degrees with n up to 8, meet at exactly that angle; axes of rotation lie
///   exactly in or across them; three planes that nearly share a line share it.
///
/// What is farther apart than that stays as it is.
void make_consistent(Structure& structure);

}  // namespace stackabilization::detail
