#pragma once

#include <optional>

#include "stackabilization/improvement/requirements.h"

namespace stackabilization::detail {

/// Returns the first check that failed, but for those of the target. Nothing: the design is acceptable, and
/// may only stack too little.
inline std::optional<Check> failed_but_target(const Assessment& assessment) {
  for (const Check& check : assessment.checks)
    if (!check.passed && !check.is_of_target()) return check;
  return std::nullopt;
}

}  // namespace stackabilization::detail
