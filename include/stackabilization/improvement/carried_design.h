#pragma once

#include "stackabilization/improvement/design.h"

namespace stackabilization {

/// A mesh that anything has deformed, as a design of `rest`: without edits, and with the primitives of the
/// structure carried along, as a DesignSpace without primitives of its own does it. So D (energy.h) of meshes
/// from different deformation models is measured on one structure. Throws InputError when `rest` is invalid,
/// UsageError unless `deformed` has its triangles and as many vertices.
Design carried_design(const StructuredShape& rest, Shape deformed);

}  // namespace stackabilization
