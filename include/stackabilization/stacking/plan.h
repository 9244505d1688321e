#pragma once

#include <cstdint>
#include <optional>

#include "stackabilization/stacking/stackability.h"

namespace stackabilization {

/// A request for a stack, such as "10 chairs within 2 m".
struct StackRequest {
  int copies = 2;        ///< N, number of copies, >= 1
  double length = 0;     ///< L, available length along r, model units, > 0
  double clearance = 0;  ///< share of f_max that is clearance, model units, >= 0
};

/// Requirements of a stack request, compared with the shape. All values hold for pure translation along r
/// (Eq. 2 and 3).
struct StackPlan {
  /// Whether a shape with the same h can fit. False when one copy does not fit (h > L), or when the
  /// clearances alone do not fit.
  bool possible = false;
  /// Largest translation between copies that fits, (L - h) / (N - 1), model units; empty for one copy.
  std::optional<double> translation;
  /// Largest f_max that fits: `translation` minus the clearance, model units; negative when impossible.
  std::optional<double> f_max;
  /// Smallest S that fits, with the clearance included in the translation: `stackability_within`. It is above
  /// 1 when one copy does not fit.
  std::optional<double> stackability;
  /// Whether the unchanged shape fits.
  bool met = false;
  /// Length of N copies of the unchanged shape, model units.
  double length_now = 0;
  /// Number of copies of the unchanged shape that fit within L; empty when it is unbounded (f_max = 0).
  std::optional<std::int64_t> copies_now;
};

/// Computes the S that belongs to the translation t = (length - h) / (copies - 1): 1 - (t / h) V(M, r) /
/// V(M). The copies fit into the length when their S, with the clearance included in the translation, is at
/// least this value. Preconditions: copies >= 2, V(M) > 0.
double stackability_within(const Stackability& measured, int copies, double length);

/// Computes the requirements of a stack request for a shape measured along r (StackabilitySolver::measure or
/// stackability()), with the clearance and play that the copies keep. Lengths within tolerance::relative of L
/// count as fitting. Throws UsageError for requests out of range.
StackPlan plan_stack(const Stackability& measured, const StackRequest& wish);

}  // namespace stackabilization
