#pragma once

#include <vector>

#include "deformation/controllers/rig.h"

namespace stackabilization::detail {

/// Progress of a class during propagation.
enum class Progress {
  open,     ///< not visited yet
  settled,  ///< visited, does not change
  modified  ///< changed: its neighbours follow
};

/// Estimates how the other parts follow an edit (paper, section 4.1; Zheng et al. 2011). Visits next the open
/// part with most modified neighbours, or the first of several such parts. Symmetric parts follow at once,
/// since they share their state. A part follows its joints: one point by a translation; two points by a
/// translation, a rotation and a stretch along the line between them; more points by the affine map of least
/// strain. The function then imposes self-symmetry again. One pass does not satisfy all constraints of a part
/// that has several; relation_solver.h then solves for all of them.
std::vector<ControlState> propagate(const Rig& rig, std::vector<ControlState> states,
                                    std::vector<Progress> progress);

}  // namespace stackabilization::detail
