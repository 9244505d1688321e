#pragma once

#include <cstdint>
#include <functional>
#include <limits>

#include "stackabilization/improvement/best_first.h"

namespace stackabilization {

/// Options of `descend_gaps`.
struct GapDescentOptions {
  double alpha = 0.2;        ///< weight of D in Eq. 5, for the energies reported
  ContactEditOptions edits;  ///< edits that contacts suggest
  int steps = 24;            ///< largest number of edits added, >= 1
  /// Largest number of designs measured, >= 0. The pursuit ends before a step that would exceed it.
  std::int64_t evaluations = std::numeric_limits<std::int64_t>::max();
  std::function<bool()> cancelled = {};  ///< asked from the calling thread and from worker threads
};

/// Result of `descend_gaps`.
struct GapDescentResult {
  Candidate candidate;           ///< the start with the edits added
  std::int64_t evaluations = 0;  ///< designs made
};

/// Greedy descent on the summed gap excess; goes beyond the paper. Where several pairs of contacts keep the
/// copies apart at the same height, separating one pair does not raise S, and a search by S alone wanders on
/// the plateau. The pursuit adds one edit after the other by the excess of all pairs of parts over the
/// separation f* that the target allows:
///
///     F = sum max(0, f_ij - f*),   f* = (1 - target) h V(M) / V(M, r)
///
/// F falls with every pair that is separated. Each step tries the edits that all regions with f > f* suggest
/// (contact_edits.h) and adds the one of least D + F / F_before. The pursuit ends when the target is reached,
/// when no edit is worth its distortion, or at a limit. Its result is coarse and is meant for refinement
/// (refinement.h). Deterministic for any number of threads.
GapDescentResult descend_gaps(const RequirementChecker& checker, const Candidate& start,
                              const GapDescentOptions& options = {});

}  // namespace stackabilization
