#pragma once

#include <functional>
#include <optional>
#include <vector>

#include "stackabilization/improvement/best_first.h"
#include "stackabilization/improvement/change_measure.h"

namespace stackabilization {

/// Options of `refined_candidate`.
struct RefinementOptions {
  int joining = 12;                           ///< further edits that may join in one round, >= 0
  ChangeMeasure least = ChangeMeasure::both;  ///< what is made small
  int evaluations = 800;  ///< designs measured at most, >= 10, but for those that tell which edits can leave
  double alpha = 0.2;     ///< of the energies reported
  double reach = 3;       ///< magnitudes are sought in [-reach, reach] times those given, > 0
  double negligible = 0.02;  ///< edits that give less than this fraction of what S gains leave if they can
  std::function<bool()> cancelled = {};  ///< asked from the calling thread; true ends with the best so far
};

/// The edit with its magnitude multiplied: x moves by x times as much, turns by x times the angle, scales by
/// the factor to the power of x. 1 gives it back, 0 changes nothing.
Edit with_magnitude(Edit edit, double x);

/// Edits that do the same thing to the same handle made into one at the place of the first, those that change
/// nothing left out.
std::vector<Edit> merged(const std::vector<Edit>& edits);

/// What `refined_candidate` came to.
struct RefinementResult {
  Candidate candidate;   ///< the best design found, with the edits it takes
  bool reached = false;  ///< it reaches the target and passes every check
  int evaluations = 0;   ///< designs measured
};

/// Beyond the paper: the search takes coarse steps; from its edits, the magnitudes that reach the target with
/// the least change. Edits of no use leave; of all that a controller model can do simply (moves and scalings
/// of parts, faces and ends), those join that promise most. Where the edits given do not reach the target,
/// first the magnitudes of largest S.
///
/// min change(x) subject to S_ij(x) >= target for every pair of blocks of the shape that come near each other
/// (parts, cut into slabs across r), and to every check of the requirements. By a bundle method: a convex
/// model of slopes, by differences evaluated in parallel, and of what earlier points showed of each
/// constraint, is minimised in a trust region (Schramm and Zowe 1992; the displacement enters as in
/// Gauss-Newton). S is a maximum over contacts, and an optimum mostly lies where several of them balance:
/// methods for smooth functions (SLSQP, tried first) get stuck on the way. Which edits join is read from the
/// multipliers of that model. The last step is a root search on the way to the shape at rest. The target is
/// met, by exact separation, and by no more than 1e-7, unless S jumps there or the change does not depend on
/// it. A local optimum, not more. The direction is kept. Never worse than what was given: if that reaches the
/// target, the change of the result is at most the same. Throws UsageError for options out of range.
/// Deterministic for any number of threads.
RefinementResult refined_candidate(const RequirementChecker& checker, const Candidate& start,
                                   const RefinementOptions& options = {});

}  // namespace stackabilization
