#pragma once

#include <cstddef>
#include <cstdint>

namespace stackabilization::detail {

/// Converts a signed row or part index to the index of a standard container.
constexpr std::size_t at(std::int32_t row) {
  return static_cast<std::size_t>(row);
}

}  // namespace stackabilization::detail
