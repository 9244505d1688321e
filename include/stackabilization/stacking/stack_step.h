#pragma once

#include <cstdint>
#include <functional>

#include "stackabilization/stacking/place.h"
#include "stackabilization/stacking/stack.h"

namespace stackabilization {

/// Options of `best_step_stack`.
struct StepOptions {
  StackOptions stack;    ///< without twist, poses and layers; at most 100 copies
  double max_shift = 0;  ///< largest shift of a copy against the one below, along u and v, model units, >= 0
  bool turn = false;     ///< whether a copy may turn about r against the one below, by any angle
  double accuracy = 0;   ///< see PlaceOptions
  std::int64_t max_cells = 5'000;             ///< limit of the cells examined, >= 1
  std::function<bool()> cancelled = {};       ///< asked from the calling thread; true ends the search early
  std::function<void(double)> progress = {};  ///< called from the calling thread with a fraction in [0, 1]
};

/// Result of `best_step_stack`.
struct StepResult {
  Place shift;                 ///< of each copy against the one below: x, y along u and v, and the turn
  BestPlace second;            ///< place and proof of the second copy on the first one
  bool straight = false;       ///< whether the straight stack is no higher; then `shift` is 0
  double straight_height = 0;  ///< height of the straight stack, model units
  StackResult stack;           ///< the lower one of the two
};

/// Searches the step from each copy to the next, a shift across r and, with `turn`, a turn about r, with
/// which the second copy comes to rest lowest on the first one; with the lift it is a screw motion. Copy k
/// takes k such steps and stops at the first of the earlier copies. The place has a bound (see best_place),
/// without clearance and play, which the stack then keeps. Of the stack with these steps and the straight one
/// the result has the lower one, the straight one where they are equal within tolerance::relative.
///
/// Deterministic for any number of threads. Throws as stack_copies and best_place do.
StepResult best_step_stack(const Shape& shape, const Direction& direction, const StepOptions& options);

}  // namespace stackabilization
