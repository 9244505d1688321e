#pragma once

#include <vector>

#include "stackabilization/core/shape.h"
#include "stackabilization/deformation/edit.h"
#include "stackabilization/structure/primitive.h"

namespace stackabilization {

/// A deformed object with the edits that made it: the state of a deformation model. A value type: every
/// candidate of a search owns its design.
struct Design {
  std::vector<Edit> edits;            ///< edits from rest, in order
  std::vector<Primitive> primitives;  ///< one primitive per part of the structure, deformed
  Shape shape;                        ///< deformed mesh; triangles and parts as at rest
};

}  // namespace stackabilization
