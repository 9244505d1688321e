#pragma once

#include <vector>

#include "envelope/separation/separation_tree.h"

namespace stackabilization::detail {

/// Removes from `triangles` every triangle with the same three points (-0 = 0), in any order, as an earlier
/// one, and returns the removed ones, sorted. Precondition: `triangles` are in the order of their indices.
/// Expected O(m).
std::vector<TriangleCopy> take_copies(std::vector<TreeTriangle>& triangles);

}  // namespace stackabilization::detail
