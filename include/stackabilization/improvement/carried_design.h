#pragma once

#include "stackabilization/deformation/deformation_model.h"

namespace stackabilization {

/// Returns the design of `rest` whose mesh is `deformed`, whatever deformed it. The design has no edits. Its
/// primitives are those of the structure at rest, carried along by the mesh as a CarriedModel
/// does. So D (energy.h) compares meshes from different deformation models on one
/// structure. Throws InputError when `rest` is invalid, UsageError unless `deformed` has the triangles and
/// the vertex count of `rest`.
Design carried_design(const StructuredShape& rest, Shape deformed);

}  // namespace stackabilization
