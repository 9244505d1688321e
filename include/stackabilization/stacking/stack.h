#pragma once

#include <Eigen/Core>
#include <optional>
#include <vector>

#include "stackabilization/core/copies.h"
#include "stackabilization/core/rational.h"
#include "stackabilization/stacking/rigid_transform.h"
#include "stackabilization/stacking/stackability.h"

namespace stackabilization {

/// Copies of a stack. Copy k (k = 0 is the lowest) is the shape moved by T_k = turn(k twist_degrees) o
/// poses[k mod K], and then lifted along r. The turn is about the line along r through `axis_point`.
struct StackOptions {
  int copies = 2;                                        ///< n, in [1, 10000]
  ContactSemantics semantics = ContactSemantics::solid;  ///< what counts as a collision
  BoxModel boxes = BoxModel::oriented;                   ///< box model of V(M) and V_stack
  double twist_degrees = 0;  ///< rotation about r from each copy to the next, degrees, right-handed
  /// A point of the twist axis, model units; default: the centre of the box, see box_axis.
  std::optional<Eigen::Vector3d> axis_point;
  /// Poses that repeat with period K. Empty: K = 1 with the unchanged shape. As many poses as copies give
  /// every copy its own pose. At most 1000 different poses. `powers(T, n)` gives T^k for copy k.
  std::vector<RigidTransform> poses;
  double clearance = 0;   ///< additional gap along r at each contact, model units, in [0, 1e60]
  double play = 0;        ///< lateral play that every contact must leave free, model units, >= 0
  int play_corners = 16;  ///< see DilationOptions
  /// Thickness of the layers of a print, model units, in [0, 1e60]; 0: none. Otherwise each copy is lifted by
  /// a whole number of layers above the one below, so that all are sliced alike, and the gap is the clearance
  /// or up to a layer more. For copies without twist or poses.
  double layer = 0;
};

/// Position of a copy in a stack: p -> transform(p) + offset * r.
struct StackedCopy {
  RigidTransform transform;  ///< T_k, without the lift
  Rational offset;           ///< lift z_k in units of r; 0 for the first copy
  double offset_length = 0;  ///< z_k |r|, model units
  /// Earlier copy that supports this copy, the nearest of several; -1: the floor.
  int rests_on = -1;
};

/// A conflict between copies that are not neighbours: copies `below` and `above`, above - below >= 2, overlap
/// when every copy rests on the one directly below it. Overlaps up to tolerance::relative of the extent of
/// the copy do not count: poses are not more accurate.
struct StackConflict {
  int below = 0;       ///< index of the lower copy, from 0
  int above = 0;       ///< index of the upper copy, from 0
  double overlap = 0;  ///< overlap along r, model units, > 0
};

/// Result of `stack_copies`.
struct StackResult {
  std::vector<StackedCopy> copies;  ///< from below upwards
  double height = 0;                ///< extent of the stack along r, model units
  /// Nesting increment: mean height per further copy of an infinite stack, model units.
  double increment = 0;
  double box_volume = 0;    ///< V(M), model units cubed
  double stack_volume = 0;  ///< V_stack, volume of the box around all copies, model units cubed
  double stackability = 0;  ///< S(M, n) = 1 - V_stack / (n V(M)), Eq. 4
  /// The deepest conflict of each copy that has one, lowest copy first. The first entry is the first conflict
  /// of the stack.
  std::vector<StackConflict> conflicts;
  /// Height that the conflicts add, model units: `height` minus the height with neighbours only.
  double conflict_height = 0;
};

/// Returns the default twist axis: the line along r through the centre of the box of the shape (`oriented`:
/// HullSupport::box_along; `frame`: frame_box).
Line box_axis(const Shape& shape, const Direction& direction, BoxModel boxes);

/// Stacks n copies along r. Each copy comes from above and stops at z_k = max over j < k of (z_j + sep(T_j M,
/// T_k M, r) + clearance), or where its lowest point reaches the floor. The floor is the level of the lowest
/// point of copy 0. (The paper considers neighbours only.)
///
/// Offsets are exact for the shapes poses[j] M and turn((k - j) twist) o poses[k] M with coordinates rounded
/// to double. The function computes sep once for each different pair, and once in total for pure translation.
/// With play, sep uses the dilated shape (see separation_with_play).
///
/// The increment is that of the infinitely repeated poses. It is exact to rounding for up to 64 poses without
/// twist (largest mean over closed chains of contacts). For one pose with twist, it is exact over contacts of
/// copies less than n apart. Otherwise it is the mean over the last period of the stack, or over the whole
/// stack when this has only one period.
///
/// With layers the lift of each copy above the one below, in units of r, is a multiple of `layer` / |r|
/// rounded to double, the next one above sep + clearance (within tolerance::relative where there is
/// clearance).
///
/// Throws UsageError for options out of range, for transforms that are not rigid, and for a clearance so
/// large that the shape vanishes in rounding. Throws InputError when `validate(shape)` fails or V(M) = 0.
StackResult stack_copies(const Shape& shape, const Direction& direction, const StackOptions& options);

/// Returns the copies of a stack in their positions. Copy k (counted from 1) is named "copyK". Lifts are
/// rounded to double.
Copies stacked_copies(const Shape& shape, const Direction& direction, const StackResult& stack);

/// Returns the stack as one shape, see as_one_shape.
Shape stacked_shape(const Shape& shape, const Direction& direction, const StackResult& stack);

}  // namespace stackabilization
