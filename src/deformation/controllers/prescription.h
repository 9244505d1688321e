#pragma once

#include <Eigen/Core>
#include <optional>

#include "deformation/controllers/part_edit.h"
#include "deformation/controllers/rig.h"
#include "stackabilization/deformation/deformation_model.h"

namespace stackabilization::detail {

/// An edit of one part, to be prescribed.
struct PrescriptionTask {
  const Primitive& now;       ///< the part before the edit
  const ControlState& start;  ///< state of its class then
  const PartEdit& edit;
  const DeformationConstraints& constraints;
};

/// The class of an edited part as the edit wants it.
struct Prescription {
  std::optional<Refusal> refusal;  ///< when set, a symmetry stands against the edit and the rest is not set
  ControlState state;
  /// Rows of linear functions of its control values (ControlState::values) that corrections must not change;
  /// nothing: no corrections at all.
  std::optional<Eigen::MatrixXd> held;
};

/// Puts the handle exactly where the edit wants it and spreads the change over the part by its edit kernel,
/// or linearly, within what its self-symmetries leave free. Corrections are to leave the handle alone, but
/// for what a move across a fixed extent leaves open.
Prescription prescription(const Rig& rig, const PrescriptionTask& task);

}  // namespace stackabilization::detail
