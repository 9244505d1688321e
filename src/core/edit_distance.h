#pragma once

#include <cstddef>
#include <string_view>

namespace stackabilization {

/// Computes Levenshtein's distance: the smallest number of insertions, removals and replacements of
/// characters that turn `a` into `b`.
std::size_t edit_distance(std::string_view a, std::string_view b);

}  // namespace stackabilization
