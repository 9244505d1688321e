#pragma once

#include <Eigen/Core>
#include <optional>
#include <vector>

#include "stackabilization/core/copies.h"
#include "stackabilization/core/rational.h"
#include "stackabilization/stacking/rigid_transform.h"
#include "stackabilization/stacking/stackability.h"

namespace stackabilization {

/// Which copies make up a stack. Copy k (k = 0 is the lowest) is the shape moved by
/// T_k = turn(k twist_degrees) o poses[k mod K], with the turn about the line along r through `axis_point`,
/// and then lifted along r.
struct StackOptions {
  int copies = 2;                                        ///< n, in [1, 10000]
  ContactSemantics semantics = ContactSemantics::solid;  ///< what counts as a collision
  BoxModel boxes = BoxModel::oriented;                   ///< of V(M) and V_stack
  double twist_degrees = 0;  ///< turn about r from each copy to the next, right-handed
  /// A point of the twist axis, model units; default: the centre of the box, see box_axis.
  std::optional<Eigen::Vector3d> axis_point;
  /// Poses repeated with period K, or as many as copies for a free choice; empty means K = 1, the shape as it
  /// is. At most 1000 different ones. T^k for every copy: powers(T, n).
  std::vector<RigidTransform> poses;
  double clearance = 0;   ///< air added along r to each contact, model units, in [0, 1e60]
  double play = 0;        ///< lateral play that every contact must allow, model units, >= 0
  int play_corners = 16;  ///< see DilationOptions
};

/// Where a copy of a stack ends up: p -> transform(p) + offset * r.
struct StackedCopy {
  RigidTransform transform;  ///< T_k, without the lift
  Rational offset;           ///< lift z_k in units of r; 0 for the first copy
  double offset_length = 0;  ///< z_k |r|, model units
  int rests_on = -1;         ///< the earlier copy that stops it, the nearest of several; -1: the floor
};

/// A conflict that looking at neighbours only would miss: copies `below` and `above`, above - below >= 2,
/// overlap by `overlap` along r (model units) when every copy rests on the one just below it. Overlaps up to
/// tolerance::relative of the copy's extent are none: that is how well poses are known.
struct StackConflict {
  int below = 0;       ///< number of the lower copy, from 0
  int above = 0;       ///< number of the upper one
  double overlap = 0;  ///< depth along r, model units, > 0
};

/// A stack made by `stack_copies`, and what it measures.
struct StackResult {
  std::vector<StackedCopy> copies;  ///< from below upwards
  double height = 0;                ///< extent of the stack along r, model units
  double increment = 0;     ///< nesting increment: height per further copy in the long run, model units
  double box_volume = 0;    ///< V(M)
  double stack_volume = 0;  ///< V_stack, the box of the union of all copies
  double stackability = 0;  ///< S(M, n) = 1 - V_stack / (n V(M)), Eq. 4
  /// The deepest conflict of each copy that has one, lowest copy first: the front is the first conflict of
  /// the stack.
  std::vector<StackConflict> conflicts;
  double conflict_height = 0;  ///< height that the conflicts cost: `height` minus that with neighbours only
};

/// The line along r through the centre of the box of the shape (`oriented`: HullSupport::box_along; `frame`:
/// frame_box), about which copies turn unless told otherwise.
Line box_axis(const Shape& shape, const Direction& direction, BoxModel boxes);

/// A stack of n copies along r, each placed against all earlier ones: every copy comes from above and stops
/// at z_k = max over j < k of (z_j + sep(T_j M, T_k M, r) + clearance), or where its lowest point reaches the
/// floor, the level of the lowest point of copy 0. (The paper looks at neighbours only.)
///
/// Offsets are exact for the shapes poses[j] M and turn((k - j) twist) o poses[k] M with coordinates rounded
/// to double; sep is computed once for each different pair, once in all for pure translation. With play, sep
/// is taken against the dilated shape (see separation_with_play).
///
/// The increment is that of the endlessly repeated poses. It is exact to rounding for up to 64 poses without
/// twist (largest mean over closed chains of contacts) and, over contacts of copies less than n apart, for
/// one pose with twist; else it is the mean over the last period of the stack, over the stack if it has but
/// one.
///
/// Throws UsageError on options outside their ranges, transforms that are not rigid or a clearance beside
/// which the shape drowns in rounding, InputError when `validate(shape)` fails or V(M) = 0.
StackResult stack_copies(const Shape& shape, const Direction& direction, const StackOptions& options);

/// The copies in their places, copy k (counted from 1) named "copyK". Lifts are rounded to double.
Copies stacked_copies(const Shape& shape, const Direction& direction, const StackResult& stack);

/// The same as one shape, see as_one_shape.
Shape stacked_shape(const Shape& shape, const Direction& direction, const StackResult& stack);

}  // namespace stackabilization
