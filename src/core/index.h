#pragma once

#include <cstddef>
#include <cstdint>

namespace stackabilization::detail {

/// Gives the place in a standard container of a row or part, which Eigen counts with signed numbers.
constexpr std::size_t at(std::int32_t row) {
  return static_cast<std::size_t>(row);
}

}  // namespace stackabilization::detail
