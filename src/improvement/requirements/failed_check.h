#pragma once

#include <optional>

#include "stackabilization/improvement/requirements.h"

namespace stackabilization::detail {

/// Returns the first check that a design fails, but for those of the target. Nothing: it is acceptable, and
/// may only stack too little.
inline std::optional<Check> failed_but_target(const RequirementChecker& checker, const Design& design,
                                              const Direction& direction) {
  for (const Check& check : checker.check(design, direction).checks)
    if (!check.passed && !check.is_of_target()) return check;
  return std::nullopt;
}

}  // namespace stackabilization::detail
