#include "stackabilization/stacking/stack_step.h"

#include <cmath>
#include <utility>

#include "stackabilization/core/errors.h"
#include "stackabilization/core/tolerances.h"

namespace stackabilization {

namespace {

constexpr int max_copies = 100;

PlaceOptions place_options(const StepOptions& options, const Place& middle) {
  PlaceOptions place;
  place.semantics = options.stack.semantics;
  for (const auto& [x, y] : {std::pair(-1, -1), std::pair(1, -1), std::pair(1, 1), std::pair(-1, 1)})
    place.region.emplace_back(middle.x + x * options.max_shift, middle.y + y * options.max_shift);
  place.turn = options.turn;
  place.accuracy = options.accuracy;
  place.max_cells = options.max_cells;
  place.cancelled = options.cancelled;
  place.progress = options.progress;
  return place;
}

}  // namespace

StepResult best_step_stack(const Shape& shape, const Direction& direction, const StepOptions& options) {
  if (!(options.max_shift >= 0 && std::isfinite(options.max_shift)))
    throw UsageError("the largest shift must be a finite length of at least 0");
  if (options.stack.copies > max_copies)
    throw UsageError("a stack with a step between its copies has at most 100 copies");
  if (!options.stack.poses.empty() || reduced_degrees(options.stack.twist_degrees) != 0)
    throw UsageError("a stack with a step between its copies has neither poses nor a twist of its own");
  StepResult result;
  result.stack = stack_copies(shape, direction, options.stack);
  result.straight_height = result.stack.height;
  result.straight = true;
  const Place given = given_place(shape, direction);
  result.second = best_place(shape, shape, direction, place_options(options, given));
  const Drop& drop = result.second.drop;
  StackOptions stepped = options.stack;
  stepped.poses = powers(drop.transform, options.stack.copies);
  StackResult stack = stack_copies(shape, direction, stepped);
  if (!(stack.height < result.straight_height * (1 - tolerance::relative))) return result;
  result.straight = false;
  result.shift = {drop.place.x - given.x, drop.place.y - given.y, drop.place.yaw_degrees};
  result.stack = std::move(stack);
  return result;
}

}  // namespace stackabilization
