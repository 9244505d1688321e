#pragma once

#include <vector>

#include "deformation/controllers/rig.h"

namespace stackabilization::detail {

/// Rows of `rig.joints`, ascending: the first of those that the symmetry relations take onto each other. The
/// others hold with it in every state of the classes, as they do in one that is tried out, to
/// tolerance::relative of the diagonal. Needs everything else of the rig.
std::vector<int> distinct_joints(const Rig& rig);

}  // namespace stackabilization::detail
