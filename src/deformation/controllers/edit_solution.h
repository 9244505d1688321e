#pragma once

#include <vector>

#include "deformation/controllers/extent_bounds.h"
#include "deformation/controllers/mesh_transfer.h"
#include "deformation/controllers/part_edit.h"
#include "deformation/controllers/rig.h"
#include "mesh/surface_index.h"
#include "stackabilization/deformation/controller_model.h"
#include "stackabilization/deformation/edit.h"

namespace stackabilization::detail {

/// A mesh on a rig.
struct RiggedMesh {
  MeshTransfer transfer;
  std::vector<std::vector<int>> by_class;  ///< see vertices_by_class
  SurfaceIndex surface;                    ///< at rest
};

/// An edit to be solved for.
struct EditTask {
  const Shape& shape;  ///< at rest
  const std::vector<Primitive>& now;
  std::vector<PartEdit> wanted;  ///< of one part, or of every part in order
  const DeformationConstraints& constraints;
};

/// Makes the edit with all relations and constraints, or says why not: prescribes the controls of the edited
/// part within its symmetries, propagates, solves, checks. An edit of every part starts the solve; joints may
/// then shift what it left by as much as a cylinder misses the affine map. See ControllerModel::edited.
EditOutcome solved_edit(const Rig& rig, const RiggedMesh& mesh, const EditTask& task);

}  // namespace stackabilization::detail
