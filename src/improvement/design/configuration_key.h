#pragma once

#include <cstdint>

#include "stackabilization/improvement/design.h"

namespace stackabilization::detail {

/// Names configurations: two that agree to rounding have the same key, also where one is moved as a
/// whole; two that differ by more than 1e-6 of the diagonal do not (but for collisions of 64 bits).
/// Displacements from rest are rounded to that grid, so that what did not move lies in the middle of a cell.
class ConfigurationKeys {
 public:
  explicit ConfigurationKeys(const DesignSpace& space);

  std::uint64_t key(const Design& design) const;

 private:
  const DesignSpace& space_;
  Design rest_;
  double grid_;  ///< model units
};

}  // namespace stackabilization::detail
