#pragma once

#include "stackabilization/deformation/edit.h"

namespace stackabilization {

inline const Handle whole_shape{HandleKind::shape, 0, 0};

}  // namespace stackabilization
