#pragma once

#include <string>
#include <vector>

#include "stackabilization/stacking/stack.h"

namespace stackabilization {

/// Objective of `best_twist`.
enum class TwistGoal {
  stackability,  ///< largest S(M, n)
  height,        ///< smallest height of the n copies
};

/// Options of `best_twist`.
struct TwistOptions {
  StackOptions stack;                        ///< all options of the stack except the twist, which is searched
  TwistGoal goal = TwistGoal::stackability;  ///< objective
  double step_degrees = 5;                   ///< distance between samples, degrees, in [0.1, 180]
  /// Smallest step of the refinement, degrees, in (0, step_degrees].
  double finest_degrees = 0.01;
};

/// Result of `best_twist`.
struct TwistResult {
  double twist_degrees = 0;           ///< best twist, degrees, in (-180, 180]
  StackResult stack;                  ///< stack with this twist
  double untwisted_stackability = 0;  ///< S(M, n) without twist
  double untwisted_height = 0;        ///< height without twist, model units
};

/// Searches the best twist per copy about r for n copies. It tries samples of the whole turn, the fractions
/// 360 / k for k up to 12 in both directions, and 0. A pattern search then refines the best four.
///
/// For the goal `stackability`, the search compares twists by the box of the stack with one axis along r, and
/// finally compares the finalists and 0 by Eq. 4. Of twists equally good within tolerance::relative, the
/// first one wins, so that round objects stay untwisted. The result is never worse than no twist.
///
/// Deterministic for any number of threads; parallel over twists. A heuristic: narrow peaks between samples
/// can be missed. Throws as stack_copies does, and UsageError for steps out of range.
TwistResult best_twist(const Shape& shape, const Direction& direction, const TwistOptions& options);

/// Options of `best_period_stack`.
struct PeriodOptions {
  /// Options of the stack. `poses` is searched and must be empty; all other options are kept.
  StackOptions stack;
  int period = 2;  ///< K, in [1, 5]
};

/// Result of `best_period_stack`.
struct PeriodResult {
  /// Pose of each copy of one period: "upright" or "flipped", followed by " turned 90", " turned 180" or "
  /// turned 270" when it is rotated.
  std::vector<std::string> poses;
  StackResult stack;  ///< stack with these poses
};

/// Searches the best stack of period K. Copy 0 is unchanged. Each other copy of the period has one of eight
/// poses about the centre of the box (see box_axis): upright or upside down (a half turn about the first side
/// of the box orthogonal to r), then rotated by 0, 90, 180 or 270 degrees about r.
///
/// The search compares all 8^(K - 1) choices by the box of the stack with one axis along r, and then the best
/// four and the straight stack by Eq. 4. Of choices equally good within tolerance::relative, the first one in
/// the order above wins. The result is never worse than the straight stack. Deterministic for any number of
/// threads.
///
/// Source: stacking items alternately turned is common packing practice; the paper stacks by translation
/// only. Throws as stack_copies does, and UsageError when K is out of range or `stack.poses` is not empty.
PeriodResult best_period_stack(const Shape& shape, const Direction& direction, const PeriodOptions& options);

}  // namespace stackabilization
