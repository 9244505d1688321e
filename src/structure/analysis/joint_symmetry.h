#pragma once

#include <vector>

#include "stackabilization/structure/structure.h"

namespace stackabilization::detail {

/// `joints` made exactly symmetric: where a symmetry takes both parts of a joint to parts (themselves or
/// others), its image is a joint as well, found nearby or added. Joints that are images of each other get the
/// mean of their points; one that is its own image lies on the plane or axis.
///
/// Precondition: the relations of `structure` are its symmetries, made consistent (`try_symmetrize`).
std::vector<Relation> symmetric_joints(const std::vector<Relation>& joints, const Structure& structure);

}  // namespace stackabilization::detail
