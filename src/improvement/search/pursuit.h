#pragma once

#include <cstdint>
#include <functional>
#include <limits>

#include "stackabilization/improvement/best_first.h"

namespace stackabilization {

/// Options of `pursued`.
struct PursuitOptions {
  double alpha = 0.2;        ///< of the energies reported
  ContactEditOptions edits;  ///< what contacts suggest
  int steps = 24;            ///< edits added at most, >= 1
  /// Designs measured at most, >= 0: a step that would take more of them than are left ends the pursuit.
  std::int64_t evaluations = std::numeric_limits<std::int64_t>::max();
  std::function<bool()> cancelled = {};  ///< asked from the calling thread
};

/// What `pursued` came to.
struct PursuitResult {
  Candidate candidate;           ///< the start with the edits that were taken
  std::int64_t evaluations = 0;  ///< designs made for it
};

/// Beyond the paper: where several pairs of contacts keep copies apart at the same height, separating one of
/// them does not raise S, so a search by S alone wanders about on the plateau. The pursuit takes edits, one
/// after the other, by the sum over all pairs of parts of what each lacks to the target,
///
///     F = sum max(0, f_ij - f*),   f* = (1 - target) h V(M) / V(M, r),
///
/// which falls with every pair that gives way: the edit of least D + F / F_before is next. The edits are
/// those that all regions with f > f* suggest (contact_edits.h). Ends when the target is reached, no edit is
/// worth its distortion, or at a limit. What it finds is coarse; refinement.h makes it good. Deterministic
/// for any number of threads.
PursuitResult pursued(const RequirementChecker& checker, const Candidate& start,
                      const PursuitOptions& options = {});

}  // namespace stackabilization
