#pragma once

#include <cstddef>
#include <vector>

#include "core/disjoint_sets.h"

// The sets of a disjoint-set structure as lists of members.
namespace stackabilization::detail {

/// Returns the sets of 0, ..., count - 1. Members ascend within a set; sets are ordered by their first
/// members.
std::vector<std::vector<int>> members_of(DisjointSets& sets, std::size_t count);

}  // namespace stackabilization::detail
