#pragma once

#include <vector>

#include "stackabilization/shape/direction.h"

namespace stackabilization::experiments {

/// `count` directions spread evenly over the hemisphere z > 0 (Fibonacci lattice), about
/// sqrt(2 pi / count) radians apart.
std::vector<Direction> hemisphere_lattice(int count);

}  // namespace stackabilization::experiments
