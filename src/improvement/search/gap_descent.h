#pragma once

#include <cstdint>
#include <functional>
#include <limits>

#include "stackabilization/improvement/best_first.h"

namespace stackabilization {

/// Excess that a descent makes small, see SummedExcess.
enum class GapMeasure {
  equal,       ///< F: pairs of parts count by how far they keep the copies apart
  by_overlap,  ///< also by how far they still are from passing each other
};

/// Options of `descend_gaps`.
struct GapDescentOptions {
  GapMeasure measure = GapMeasure::equal;  ///< excess that is made small
  double alpha = 0.2;                      ///< weight of D in Eq. 5, for the energies reported
  ContactEditOptions edits;                ///< edits that contacts suggest
  int steps = 24;                          ///< largest number of edits added, >= 1
  /// Largest number of designs measured, >= 0; one that is held against all limits of quality counts as two
  /// more. The pursuit ends before a step that would exceed it.
  std::int64_t evaluations = std::numeric_limits<std::int64_t>::max();
  std::function<bool()> cancelled = {};  ///< asked from the calling thread and from worker threads
};

/// Result of `descend_gaps`.
struct GapDescentResult {
  Candidate candidate;  ///< the start with the edits added
  double excess = 0;    ///< its summed excess F, fraction of the extent; 0 where the target is reached
  bool stuck = false;   ///< whether it ended because no edit was worth its distortion
  std::int64_t evaluations = 0;  ///< designs made
};

/// Greedy descent on the summed gap excess; goes beyond the paper. Where several pairs of contacts keep the
/// copies apart at the same height, separating one pair does not raise S, and a search by S alone wanders on
/// the plateau. The pursuit adds one edit after the other by the excess of all pairs of parts over the
/// separation f* that the target allows:
///
///     F = sum max(0, f_ij - f*),   f* = (1 - target) h V(M) / V(M, r)
///
/// F falls with every pair that is separated, but not while it is not. Where no single edit separates a pair,
/// GapMeasure::by_overlap leads through edits that each do a part of it. Each step tries the edits that all
/// regions with f > f* suggest (contact_edits.h) and adds the one of least D + F / F_before; with limits of
/// quality, of the 16 best the first one that keeps them all, if any does. An edit that is refused for the
/// size of a part that it carries along is tried after a slide of that part, and taken where no other is
/// worthwhile (follower_slide.h). The pursuit ends when the target is reached, when no edit is worth its
/// distortion, or at a limit. Its result is coarse and is meant for refinement (refinement.h). Deterministic
/// for any number of threads.
GapDescentResult descend_gaps(const RequirementChecker& checker, const Candidate& start,
                              const GapDescentOptions& options = {});

}  // namespace stackabilization
