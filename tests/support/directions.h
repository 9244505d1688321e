#pragma once

#include "stackabilization/core/direction.h"

namespace stackabilization {

/// What nearly every test stacks along.
inline const Direction upwards(0, 0, 1);

}  // namespace stackabilization
