#pragma once

#include <string>
#include <vector>

#include "stackabilization/stacking/stack.h"

namespace stackabilization {

/// What `best_twist` makes best.
enum class TwistGoal {
  stackability,  ///< largest S(M, n)
  height,        ///< least height of the n copies
};

/// The stack that `best_twist` turns, its goal and its steps.
struct TwistOptions {
  StackOptions stack;                        ///< everything but the twist, which is searched
  TwistGoal goal = TwistGoal::stackability;  ///< what is compared
  double step_degrees = 5;                   ///< distance of the samples, in [0.1, 180]
  double finest_degrees = 0.01;  ///< the best samples are refined down to this step, in (0, step_degrees]
};

/// What `best_twist` found, and what it is better than.
struct TwistResult {
  double twist_degrees = 0;           ///< in (-180, 180]
  StackResult stack;                  ///< the stack with that twist
  double untwisted_stackability = 0;  ///< S(M, n) without twist
  double untwisted_height = 0;        ///< its height, model units
};

/// The best twist per copy about r for n copies: samples of the whole turn, the fractions 360 / k for k up to
/// 12 both ways and 0, then a pattern search around the best four. For `stackability` these are compared by
/// the box of the stack with one axis along r, and the finalists and 0 by Eq. 4; of twists equally good
/// within tolerance::relative the one listed first wins, so that round objects stay untwisted. Never worse
/// than no twist.
///
/// Deterministic for any number of threads; parallel over twists. A heuristic: narrow peaks between samples
/// can be missed. Throws like stack_copies, and UsageError on steps outside their ranges.
TwistResult best_twist(const Shape& shape, const Direction& direction, const TwistOptions& options);

/// The stack for which `best_period_stack` looks for poses.
struct PeriodOptions {
  StackOptions stack;  ///< `poses` is searched and must be empty; twist, clearance and the rest are kept
  int period = 2;      ///< K, in [1, 5]
};

/// What `best_period_stack` found.
struct PeriodResult {
  /// Per copy of one period: "upright" or "flipped", with " turned 90", " turned 180" or " turned 270" where
  /// turned.
  std::vector<std::string> poses;
  StackResult stack;  ///< the stack with these poses
};

/// The best stack of period K: copy 0 as it is, each other copy of the period in one of eight poses about the
/// box's centre (see box_axis): upright or upside-down (half turn about the first side of the box across r),
/// then turned by 0, 90, 180 or 270 degrees about r. All 8^(K - 1) choices are compared by the box of the
/// stack with one axis along r, the best four and the straight stack by Eq. 4; equally good ones within
/// tolerance::relative in the order above. Never worse than the straight stack. Deterministic for any number
/// of threads.
///
/// Source: stacking items alternately turned is common packing practice; the paper stacks by translation
/// only. Throws like stack_copies, and UsageError when K is out of range or `stack.poses` is not empty.
PeriodResult best_period_stack(const Shape& shape, const Direction& direction, const PeriodOptions& options);

}  // namespace stackabilization
