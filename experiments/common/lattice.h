#pragma once

#include <vector>

#include "stackabilization/core/direction.h"

namespace stackabilization::experiments {

/// `count` directions spread evenly over the hemisphere z > 0 (Fibonacci lattice), about
/// sqrt(2 pi / count) radians apart.
std::vector<Direction> hemisphere_lattice(int count);

/// `count` independent directions, uniform over that hemisphere; fewer directions of the same seed are the
/// first of more.
std::vector<Direction> random_directions(int count, unsigned seed);

}  // namespace stackabilization::experiments
