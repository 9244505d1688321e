#pragma once

#include <map>
#include <memory>
#include <optional>
#include <tuple>
#include <vector>

#include "stackabilization/envelope/separation.h"
#include "stackabilization/stacking/stack.h"
#include "stacking/measure/exact_span.h"

namespace stackabilization {

/// Lift that one copy requires of a later copy.
struct Demand {
  bool blocked = false;  ///< whether the copies can collide; otherwise they pass each other at any height
  /// Smallest lift between the copies: sep plus clearance in whole layers, in units of r, exact.
  Rational lift;
  double approximate = 0;  ///< nearest double of `lift`
};

/// The different poses of a stack and the lifts between pairs of copies. Lifts are computed on first use and
/// cached. Shared by stack_copies and the searches over stacks. Not to be shared between threads.
class StackPairs {
 public:
  /// Checks all options; throws as stack_copies does.
  StackPairs(const Shape& shape, const Direction& direction, const StackOptions& options);

  /// Returns the same poses with another twist. The prepared shapes are shared, the lifts are not.
  StackPairs with_twist(double degrees) const;

  /// Returns the pose of each of the copies 0 ... K - 1. Equal poses have equal indices.
  const std::vector<int>& sequence() const { return sequence_; }
  /// Returns the span along r of a copy with this pose, without twist.
  const Span& span(int pose) const { return (*poses_)[static_cast<std::size_t>(pose)].span; }
  /// Returns whether each copy is rotated against the copy below.
  bool twisted() const { return twist_degrees_ != 0; }
  /// Returns the rotation of a copy about the axis, degrees, in (-180, 180].
  double turn_degrees(int copy) const { return reduced_degrees(copy * twist_degrees_); }
  /// Returns T_k of a copy with this pose.
  RigidTransform transform(int pose, int copy) const;
  /// Returns the lift that copy j with pose `below` requires of copy j + lag with pose `above`.
  const Demand& demand(int below, int above, int lag);
  const Direction& direction() const { return direction_; }  ///< r
  /// Returns the most that a demand adds to sep, units of r.
  double max_gap() const { return clearance_ + layer_; }

 private:
  struct Pose {
    RigidTransform transform;
    Shape shape;
    Span span;
    SeparationTree tree;
    /// Tree of the dilated shape as a lower copy; only with play.
    std::optional<SeparationTree> dilated_tree;
  };

  Direction direction_;
  ContactSemantics semantics_;
  double twist_degrees_;
  double clearance_;  ///< units of r, and so is the layer
  double layer_;
  Line axis_;
  std::shared_ptr<const std::vector<Pose>> poses_;
  std::vector<int> sequence_;
  /// Key: rotation between the copies, and their poses.
  std::map<std::tuple<double, int, int>, Demand> demands_;
};

}  // namespace stackabilization
