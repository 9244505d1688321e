#pragma once

#include <cstddef>
#include <vector>

#include "core/disjoint_sets.h"

/// Not installed.
namespace stackabilization::detail {

/// The sets of 0, ..., count - 1: members ascending, sets by their first members.
std::vector<std::vector<int>> members_of(DisjointSets& sets, std::size_t count);

}  // namespace stackabilization::detail
