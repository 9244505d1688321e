#pragma once

#include <vector>

#include "stackabilization/structure/structure.h"

namespace stackabilization::detail {

/// Makes `joints` exactly symmetric. Where a symmetry maps both parts of a joint to parts, the image of the
/// joint is a joint as well; the function finds it nearby or adds it. Joints that are images of each other
/// get the mean of their points. A joint that is its own image is moved onto the plane or axis.
///
/// Precondition: the relations of `structure` are its symmetries, made consistent by `try_symmetrize`.
std::vector<Relation> symmetric_joints(const std::vector<Relation>& joints, const Structure& structure);

}  // namespace stackabilization::detail
