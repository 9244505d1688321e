#pragma once

#include <functional>
#include <optional>
#include <vector>

#include "stackabilization/improvement/best_first.h"
#include "stackabilization/improvement/change_measure.h"

namespace stackabilization {

/// Smallest number of designs with which a refinement is of use.
inline constexpr int min_refinement_evaluations = 10;

/// Options of `refine_candidate`.
struct RefinementOptions {
  int max_added_edits = 12;                       ///< edits added per round, chosen by reduced cost, >= 0
  ChangeMeasure objective = ChangeMeasure::both;  ///< objective to minimise
  /// Largest number of designs measured, >= min_refinement_evaluations. The test of which edits can be
  /// dropped may exceed it.
  int evaluations = 800;
  double alpha = 0.2;  ///< weight of D in Eq. 5, for the energies reported
  /// Bound of the magnitudes, > 0: they lie in [-reach, max(reach, 1)] times those given.
  double magnitude_bound = 3;
  /// Drop edits whose removal loses less than this fraction of the total gain in S, if the other edits can
  /// make up for it; >= 0.
  double drop_threshold = 0.02;
  /// Price of an edit: fraction of the change by which it may grow for each edit dropped, >= 0.
  double edit_price = 0;
  /// Whether edits are added to reach the target, those that S asks for most first, if those given do not.
  bool reach_with_added = false;
  EditFamily family = EditFamily::extended;  ///< family of the edits added
  std::function<bool()> cancelled = {};  ///< asked from the calling thread; true ends with the best so far
};

/// Returns the edit with its magnitude multiplied by x: a move or leaning goes x times as far, a rotation
/// turns by x times the angle, a scaling or taper has its factor to the power of x. x = 1 gives the same
/// edit, x = 0 changes nothing, x = -1 gives the inverse.
Edit with_magnitude(Edit edit, double x);

/// Merges edits that do the same to the same handle into one, at the position of the first: moves along one
/// line, leanings of one axis along one line, rotations about one axis, scalings along one axis or uniform,
/// tapers of one axis. Leaves out edits that change nothing.
std::vector<Edit> merge_edits(const std::vector<Edit>& edits);

/// Result of `refine_candidate`.
struct RefinementResult {
  Candidate candidate;   ///< the best design found, with its edits
  bool reached = false;  ///< whether it reaches the target and passes every check
  int evaluations = 0;   ///< designs measured
};

/// Minimises the change of a candidate subject to the target, over the continuous magnitudes of its edits.
/// Goes beyond the paper, whose search takes coarse steps.
///
///     min change(x)  subject to  S_ij(x) >= target for all pairs of blocks i, j that come near each other
///                                and every check of the requirements
///
/// Blocks are the parts of the shape, cut into slabs across r.
///
/// Method: a bundle method (Schramm and Zowe 1992). It minimises a convex model in a trust region. The model
/// holds slopes at the current point and cuts: the linearised constraints at points tried before. Slopes are
/// finite differences, evaluated in parallel. The displacement enters as in Gauss-Newton. f_max is a maximum
/// over contacts, and most optima lie where several contacts balance; methods for smooth functions (SLSQP,
/// tried first) stop before they get there.
///
/// Steps: if the given edits do not reach the target, magnitudes of largest S are searched first. Edits that
/// are of no use are removed. With controllers further edits are added (moves and scalings of parts, faces
/// and ends), those of the largest reduced cost according to the multipliers of the model. A root search on
/// the segment to the shape at rest comes last.
///
/// Guarantees: a local optimum only. The target is met by the exact separation, and exceeded by at most 1e-7
/// (tolerance::target) unless S jumps there or the change does not depend on it. The direction is kept. The
/// result is never worse than the start: if the start reaches the target, the change of the result is at most
/// that of the start. Deterministic for any number of threads. Throws UsageError for options out of range.
RefinementResult refine_candidate(const RequirementChecker& checker, const Candidate& start,
                                  const RefinementOptions& options = {});

}  // namespace stackabilization
