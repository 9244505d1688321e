#include "stacking/stacks/stack_boxes.h"

#include "stackabilization/core/errors.h"
#include "stackabilization/core/tolerances.h"

namespace stackabilization {

StackBoxes::StackBoxes(const Shape& shape, const Direction& direction, BoxModel model)
    : hull_(shape), direction_(direction), model_(model) {
  shape_volume_ = box_volume(hull_, model);
  if (!(shape_volume_ > 0))
    throw InputError("the box of the shape has no volume, so its stackability is undefined");
}

double StackBoxes::stack_volume(const Points& points) const {
  const OrientedBox box =
      model_ == BoxModel::oriented ? minimal_oriented_box(HullSupport(points)) : box_along(points);
  if (!(box.half_extents.minCoeff() > tolerance::rounding * box.half_extents.maxCoeff()))
    throw UsageError("the stack is too high for its width to be measured: choose a smaller clearance");
  return box.volume();
}

OrientedBox StackBoxes::box_along(const Points& points) const {
  return model_ == BoxModel::oriented ? HullSupport(points).box_along(direction_)
                                      : frame_box(points, direction_);
}

StackResult build_stack(StackPairs& pairs, const std::vector<int>& sequence, int copies,
                        const StackBoxes& boxes) {
  const double unit = boxes.direction().length();
  const Placement placed = place(pairs, sequence, copies, Reach::all);
  const Placement neighbours = place(pairs, sequence, copies, Reach::neighbour);

  StackResult stack;
  for (int k = 0; k < copies; ++k) {
    const auto copy = static_cast<std::size_t>(k);
    stack.copies.push_back({pairs.transform(sequence[copy % sequence.size()], k), placed.lifts[copy],
                            placed.approximate[copy] * unit, placed.rests_on[copy]});
  }
  stack.height = placed_height(pairs, sequence, placed) * unit;
  stack.increment = long_run_increment(pairs, sequence, placed) * unit;
  stack.box_volume = boxes.shape_volume();
  stack.stack_volume = boxes.stack_volume(stack_hull_points(pairs, sequence, placed, boxes.hull()));
  stack.stackability = 1 - stack.stack_volume / (copies * stack.box_volume);
  stack.conflicts = find_conflicts(pairs, sequence, neighbours);
  for (StackConflict& conflict : stack.conflicts) conflict.overlap *= unit;
  if (!stack.conflicts.empty())
    stack.conflict_height = stack.height - placed_height(pairs, sequence, neighbours) * unit;
  return stack;
}

}  // namespace stackabilization
