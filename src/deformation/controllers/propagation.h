#pragma once

#include <vector>

#include "deformation/controllers/rig.h"

namespace stackabilization::detail {

/// What happened to a class before its neighbours are asked.
enum class Progress {
  open,     ///< not looked at yet
  settled,  ///< stays as it is
  modified  ///< moved: its neighbours follow
};

/// Guess of how the other parts follow an edit (paper, section 4.1; Zheng et al. 2011): of the open parts the
/// one with most modified neighbours is next, ties by index; symmetric parts follow at once, since they share
/// their state; a part follows its joints by a translation (one point), with a rotation and a stretch between
/// them (two), by the affine map of least strain (more); self-symmetry is imposed again. One pass drops
/// constraints where a part has several: relation_solver.h finishes.
std::vector<ControlState> propagated(const Rig& rig, std::vector<ControlState> states,
                                     std::vector<Progress> progress);

}  // namespace stackabilization::detail
