#pragma once

#include "stacking/stacks/stack_placement.h"

namespace stackabilization {

/// Volumes of the boxes of a shape and of stacks of it, in one box model. What stack_copies and the searches
/// over stacks share; not meant for users. Safe to share between threads.
class StackBoxes {
 public:
  /// Throws InputError when V(M) = 0.
  StackBoxes(const Shape& shape, const Direction& direction, BoxModel model);

  const HullSupport& hull() const { return hull_; }          ///< of the shape, not of a stack
  const Direction& direction() const { return direction_; }  ///< r
  double shape_volume() const { return shape_volume_; }      ///< V(M)
  /// V_stack of Eq. 4 for a stack with the hull of `points`. Throws UsageError when it drowns in rounding.
  double stack_volume(const Points& points) const;
  /// The box with one axis along r: its volume is at least V_stack, cheaper, and equal to it for `frame`.
  OrientedBox box_along(const Points& points) const;

 private:
  HullSupport hull_;
  Direction direction_;
  BoxModel model_;
  double shape_volume_;
};

/// Places the copies and measures the stack.
StackResult build_stack(StackPairs& pairs, const std::vector<int>& sequence, int copies,
                        const StackBoxes& boxes);

}  // namespace stackabilization
