#pragma once

#include <vector>

#include "envelope/separation/separation_tree.h"

namespace stackabilization::detail {

/// Takes out of `triangles`, which are in the order of their indices, those with the same three points as an
/// earlier one, in whatever order (-0 = 0); returns them, sorted. Expected O(m).
std::vector<TriangleCopy> take_copies(std::vector<TreeTriangle>& triangles);

}  // namespace stackabilization::detail
