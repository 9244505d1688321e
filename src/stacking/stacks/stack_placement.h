#pragma once

#include <vector>

#include "stackabilization/mesh/boxes.h"
#include "stacking/stacks/stack_pairs.h"

namespace stackabilization {

// What stack_copies and the searches over stacks share; not meant for users. `sequence` holds the poses of
// one period.

/// Which earlier copies a copy looks at.
enum class Reach { neighbour, all };

/// Lifts of the copies of a stack, from below upwards.
struct Placement {
  std::vector<Rational> lifts;      ///< z_k in units of r
  std::vector<double> approximate;  ///< nearest doubles of `lifts`
  std::vector<int> rests_on;        ///< -1: floor
};

/// Places `copies` copies with poses sequence[k mod K] from below upwards.
Placement place(StackPairs& pairs, const std::vector<int>& sequence, int copies, Reach reach);

/// Extent of the placed copies along r, in units of r.
double placed_height(const StackPairs& pairs, const std::vector<int>& sequence, const Placement& placement);

/// The deepest conflict of each copy when the copies stand as in `neighbours`, a placement by
/// Reach::neighbour.
std::vector<StackConflict> find_conflicts(StackPairs& pairs, const std::vector<int>& sequence,
                                          const Placement& neighbours);

/// Height per further copy in the long run, in units of r.
double long_run_increment(StackPairs& pairs, const std::vector<int>& sequence, const Placement& placement);

/// Points whose hull is the hull of the stack: for each pose and turn the lowest and the highest copy's
/// `hull_points`.
Points stack_hull_points(const StackPairs& pairs, const std::vector<int>& sequence,
                         const Placement& placement, const HullSupport& hull);

}  // namespace stackabilization
