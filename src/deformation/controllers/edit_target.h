#pragma once

#include <Eigen/Core>
#include <optional>

#include "deformation/controllers/part_edit.h"
#include "deformation/controllers/rig.h"
#include "stackabilization/deformation/deformation_model.h"

namespace stackabilization::detail {

/// An edit of one part and the state that it starts from.
struct EditTargetTask {
  const Primitive& now;       ///< primitive of the part before the edit
  const ControlState& start;  ///< state of its class before the edit
  const PartEdit& edit;
  const DeformationConstraints& constraints;
};

/// State of the class of an edited part that an edit prescribes.
struct EditTarget {
  /// Set when a symmetry contradicts the edit; the other members are then not set.
  std::optional<Refusal> refusal;
  ControlState state;
  /// Linear functions of the control values of the class (ControlState::values), one per row, that
  /// corrections must not change. Without a value, corrections of the class are forbidden.
  std::optional<Eigen::MatrixXd> held;
};

/// Computes the state in which the handle is exactly where the edit puts it. The change spreads over the part
/// by its edit kernel, or linearly, within the subspace of its self-symmetries. Corrections must not change
/// the handle, except for the heights that a move across a fixed extent leaves free.
EditTarget edit_target(const Rig& rig, const EditTargetTask& task);

}  // namespace stackabilization::detail
