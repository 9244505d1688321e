#pragma once

#include <functional>
#include <optional>
#include <vector>

#include "stackabilization/improvement/best_first.h"

namespace stackabilization {

/// Which magnitudes are looked for.
enum class Companions {
  none,      ///< those of the edits given
  opposite,  ///< also of the same operations on the opposite handles: what one end takes, the other gives
             ///< back
};

/// Options of `refined_candidate`.
struct RefinementOptions {
  Companions companions = Companions::opposite;  ///< of the edits given
  int evaluations = 300;                         ///< designs measured at most, >= 10
  double alpha = 0.2;                            ///< of the energies reported
  double reach = 3;          ///< magnitudes are sought in [-reach, reach] times those given, > 0
  double negligible = 0.02;  ///< edits that give less than this fraction of what S gains are tried without
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
/// the least D. Edits of their opposite handles (the other end, the opposite face) may join them, edits of no
/// use leave. Where the edits given do not reach it, first the magnitudes of largest S.
///
/// min D(x) subject to S_ij(x) >= target for every pair of blocks of the shape that come near each other
/// (parts, cut into slabs across r): each is smooth where their maximum is not; and to every check of the
/// requirements. By NLopt's SLSQP, with a variable of its own for the magnitude of every change that D adds
/// up, and slopes by differences evaluated in parallel; the last step is a root search on the way to the
/// shape at rest. The target is met, by exact separation, and by no more than 1e-7, unless S jumps there or D
/// does not depend on it. A local optimum, not more. The direction is kept. Never worse than what was given:
/// if that reaches the target, D of the result is at most the same. Throws UsageError for options out of
/// range. Deterministic for any number of threads.
RefinementResult refined_candidate(const RequirementChecker& checker, const Candidate& start,
                                   const RefinementOptions& options = {});

}  // namespace stackabilization
