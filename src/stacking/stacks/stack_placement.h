#pragma once

#include <vector>

#include "stackabilization/mesh/boxes.h"
#include "stacking/stacks/stack_pairs.h"

namespace stackabilization {

// Placement of copies, shared by stack_copies and the searches over stacks. `sequence` always holds the poses
// of one period.

/// Earlier copies that a copy is placed against: only the one below, or all.
enum class Reach { neighbour, all };

/// Lifts of the copies of a stack, lowest copy first.
struct Placement {
  std::vector<Rational> lifts;      ///< z_k in units of r
  std::vector<double> approximate;  ///< nearest doubles of `lifts`
  std::vector<int> rests_on;        ///< supporting copy of each copy; -1: floor
};

/// Places `copies` copies with the poses sequence[k mod K], lowest copy first.
Placement place(StackPairs& pairs, const std::vector<int>& sequence, int copies, Reach reach);

/// Computes the extent of the placed copies along r, in units of r.
double placed_height(const StackPairs& pairs, const std::vector<int>& sequence, const Placement& placement);

/// Finds the deepest conflict of each copy in `neighbours`, a placement by Reach::neighbour.
std::vector<StackConflict> find_conflicts(StackPairs& pairs, const std::vector<int>& sequence,
                                          const Placement& neighbours);

/// Computes the mean height per further copy of an infinite stack, in units of r.
double long_run_increment(StackPairs& pairs, const std::vector<int>& sequence, const Placement& placement);

/// Returns points with the same convex hull as the stack: for each pose and rotation, the hull points of the
/// lowest and of the highest copy.
Points stack_hull_points(const StackPairs& pairs, const std::vector<int>& sequence,
                         const Placement& placement, const HullSupport& hull);

}  // namespace stackabilization
