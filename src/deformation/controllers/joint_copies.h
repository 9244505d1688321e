#pragma once

#include <vector>

#include "deformation/controllers/rig.h"

namespace stackabilization::detail {

/// Returns the first joint of every orbit of the symmetry relations: rows of `rig.joints`, ascending. The
/// other joints of an orbit hold whenever the first one holds, in every state of the classes. The function
/// verifies this in one generic state, within tolerance::relative of the diagonal. Precondition: all other
/// members of `rig` are set.
std::vector<int> distinct_joints(const Rig& rig);

}  // namespace stackabilization::detail
