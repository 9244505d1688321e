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

/// What one copy asks of a later one: a lift of at least `lift` between them, in units of r, if they can meet
/// at all.
struct Demand {
  bool blocked = false;    ///< else they pass each other at any height
  Rational lift;           ///< sep plus clearance, exact
  double approximate = 0;  ///< nearest double of it
};

/// The different poses of a stack and what each pair of copies demands, computed when first asked for and
/// kept. Not to be shared between threads. What stack_copies and the searches over stacks share; not meant
/// for users.
class StackPairs {
 public:
  /// Checks every option of `options`; see stack_copies for the errors.
  StackPairs(const Shape& shape, const Direction& direction, const StackOptions& options);

  /// The same poses with another twist; the prepared shapes are shared, the demands are not.
  StackPairs with_twist(double degrees) const;

  /// Index of the pose of copies 0 ... K - 1; equal poses have equal indices.
  const std::vector<int>& sequence() const { return sequence_; }
  /// Span along r of a copy with this pose, not twisted.
  const Span& span(int pose) const { return (*poses_)[static_cast<std::size_t>(pose)].span; }
  /// Whether each copy is turned against the one below.
  bool twisted() const { return twist_degrees_ != 0; }
  /// Turn of copy k about the axis, in (-180, 180].
  double turn_degrees(int copy) const { return reduced_degrees(copy * twist_degrees_); }
  /// T_k of a copy with this pose.
  RigidTransform transform(int pose, int copy) const;
  /// Demand of copy j with pose `below` on copy j + lag with pose `above`.
  const Demand& demand(int below, int above, int lag);
  const Direction& direction() const { return direction_; }  ///< r
  double clearance() const { return clearance_; }            ///< in units of r

 private:
  struct Pose {
    RigidTransform transform;
    Shape shape;
    Span span;
    SeparationTree tree;
    std::optional<SeparationTree> dilated_tree;  ///< of the shape as a lower copy, where there is play
  };

  Direction direction_;
  ContactSemantics semantics_;
  double twist_degrees_;
  double clearance_;
  Line axis_;
  std::shared_ptr<const std::vector<Pose>> poses_;
  std::vector<int> sequence_;
  std::map<std::tuple<double, int, int>, Demand> demands_;  ///< by turn between the copies and their poses
};

}  // namespace stackabilization
