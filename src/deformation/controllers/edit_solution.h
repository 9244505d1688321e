#pragma once

#include <optional>
#include <vector>

#include "deformation/controllers/extent_bounds.h"
#include "deformation/controllers/mesh_transfer.h"
#include "deformation/controllers/part_edit.h"
#include "deformation/controllers/rig.h"
#include "mesh/surface_index.h"
#include "stackabilization/deformation/edit.h"
#include "stackabilization/deformation/refusal.h"

namespace stackabilization::detail {

/// A mesh bound to a rig.
struct RiggedMesh {
  MeshTransfer transfer;
  std::vector<std::vector<int>> by_class;  ///< see vertices_by_class
  SurfaceIndex surface;                    ///< surface at rest
};

/// An edit to solve for.
struct EditTask {
  const Shape& shape;                 ///< shape at rest
  const std::vector<Primitive>& now;  ///< primitives before the edit
  std::vector<PartEdit> wanted;       ///< one edit of one part, or one edit of every part in order
  const DeformationConstraints& constraints;
  /// Whether the edits of all parts only say where parts go about: they are made symmetric first, and parts
  /// may follow in any way to close joints.
  bool is_taper = false;
  /// Whether a part that moves as a whole may give way across the move, so that others keep their form.
  bool gives_way = false;
};

/// Result of an edit: the primitives after it, or the reason for the refusal.
struct EditOutcome {
  /// Set when the edit was refused; `primitives` are then those before the edit.
  std::optional<Refusal> refusal;
  std::vector<Primitive> primitives;  ///< one per part
};

/// Applies the edit subject to all relations and constraints, or returns the reason for the refusal. The
/// function prescribes the controls of the edited part within its symmetries, propagates, solves and checks.
/// A part that gives way first tries to close its joints alone: its control points keep their heights along
/// the move, and it changes across the move only, as a rung does that moves up between legs that lean. The
/// solve of an edit of every part starts from the prescriptions of all parts; joints may then shift the parts
/// by as much as a cylinder deviates from the affine map. See ControllerModel::edited.
EditOutcome solve_edit(const Rig& rig, const RiggedMesh& mesh, const EditTask& task);

}  // namespace stackabilization::detail
