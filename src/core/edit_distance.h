#pragma once

#include <cstddef>
#include <string_view>

namespace stackabilization {

/// Levenshtein's distance: insertions, removals and replacements of characters that lead from `a` to `b`.
std::size_t edit_distance(std::string_view a, std::string_view b);

}  // namespace stackabilization
