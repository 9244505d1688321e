#pragma once

#include <cstdint>

#include "stackabilization/stacking/stackability.h"

namespace stackabilization {

/// A shape as an item of a load planner that counts in whole units: a box, and how far each further copy
/// sinks into the one below. Planners take box height + (n - 1) (box height - nesting height) for n copies,
/// as rule 2.1 of the ROADEF/EURO challenge 2022 does.
struct LoadItem {
  std::int64_t length = 0;          ///< longer side of the smallest rectangle around the shape seen along r
  std::int64_t width = 0;           ///< its shorter side
  std::int64_t height = 0;          ///< extent h(M, r), or the increment where air makes that larger
  std::int64_t nesting_height = 0;  ///< height - increment, >= 0
  std::int64_t increment = 0;       ///< f_max, with clearance and play: what each further copy adds
};

/// Measures a shape along r as an item, in whole units of length `step`, model units. All lengths are rounded
/// up, so that what a planner takes for a stack is never below its true height; what is within
/// tolerance::relative above a whole unit counts as that unit. Clearance and play are those of the solver.
/// Throws UsageError when the step is not above 0, or a length of the shape is more than 2^53 steps.
LoadItem load_item(const StackabilitySolver& solver, const Direction& direction, double step);

}  // namespace stackabilization
