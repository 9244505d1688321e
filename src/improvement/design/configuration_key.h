#pragma once

#include <cstdint>

#include "stackabilization/deformation/deformation_model.h"

namespace stackabilization::detail {

/// Fingerprints of configurations. Designs that agree up to rounding and a translation of the whole have
/// equal keys. Designs that differ by more than 1e-6 of the diagonal have different keys (except for
/// collisions of 64 bits). Displacements from rest are rounded to that grid, so that whatever did not move
/// lies in the middle of a cell.
class ConfigurationKeys {
 public:
  explicit ConfigurationKeys(const DeformationModel& space);

  std::uint64_t key(const Design& design) const;

 private:
  const DeformationModel& space_;
  Design rest_;
  double grid_;  ///< grid step, model units
};

}  // namespace stackabilization::detail
