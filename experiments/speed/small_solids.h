#pragma once

#include <string>
#include <utility>
#include <vector>

#include "stackabilization/core/shape.h"

namespace stackabilization::experiments {

/// Closed solids of at most a hundred triangles, with their names: few enough for Minkowski sums.
std::vector<std::pair<std::string, Shape>> small_solids();

}  // namespace stackabilization::experiments
