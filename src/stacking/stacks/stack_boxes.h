#pragma once

#include "stacking/stacks/stack_placement.h"

namespace stackabilization {

/// Volumes of the boxes of a shape and of its stacks, in one box model. Shared by stack_copies and the
/// searches over stacks. Safe to share between threads.
class StackBoxes {
 public:
  /// Throws InputError when V(M) = 0.
  StackBoxes(const Shape& shape, const Direction& direction, BoxModel model);

  const HullSupport& hull() const { return hull_; }          ///< hull of the shape, not of a stack
  const Direction& direction() const { return direction_; }  ///< r
  double shape_volume() const { return shape_volume_; }      ///< V(M), model units cubed
  /// Computes V_stack of Eq. 4, model units cubed, for a stack with the hull of `points`. Throws UsageError
  /// when the volume vanishes in rounding.
  double stack_volume(const Points& points) const;
  /// Computes the box with one axis along r. Its volume is at least V_stack, and equal to it for `frame`. It
  /// is cheaper than `stack_volume`.
  OrientedBox box_along(const Points& points) const;

 private:
  HullSupport hull_;
  Direction direction_;
  BoxModel model_;
  double shape_volume_;
};

/// Places the copies and measures the stack. `sequence`: poses of one period.
StackResult build_stack(StackPairs& pairs, const std::vector<int>& sequence, int copies,
                        const StackBoxes& boxes);

}  // namespace stackabilization
