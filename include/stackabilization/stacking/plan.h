#pragma once

#include <cstdint>
#include <optional>

#include "stackabilization/stacking/stackability.h"

namespace stackabilization {

/// "10 chairs within 2 m."
struct StackRequest {
  int copies = 2;        ///< N, >= 1
  double length = 0;     ///< L, room along r, model units, > 0
  double clearance = 0;  ///< share of f_max that is air along r, model units, >= 0
};

/// What a wish takes, and how far the shape is from it. All for pure translation along r (Eq. 2 and 3).
struct StackPlan {
  /// False when not even one copy fits (h > L), or when the clearances alone do not: no change of shape that
  /// keeps h helps.
  bool possible = false;
  /// Largest translation from copy to copy that fits, (L - h) / (N - 1), model units; nothing for one copy.
  std::optional<double> translation;
  /// Largest f_max that fits: `translation` minus the clearance, model units; negative when impossible.
  std::optional<double> f_max;
  /// Least S that fits, with the air counted as part of each copy: stackability_within; above 1 when not even
  /// one copy fits.
  std::optional<double> stackability;
  /// Whether the shape as it is fits.
  bool met = false;
  /// Length that N copies of the shape as it is take, model units.
  double length_now = 0;
  /// How many copies of the shape as it is fit within L; nothing when there is no end to it (f_max = 0).
  std::optional<std::int64_t> copies_now;
};

/// S with the translation (length - h) / (copies - 1) from copy to copy: 1 - (translation / h) V(M, r) /
/// V(M). Copies fit into the length when S, with the air between them counted in the translation, is at least
/// that. Preconditions: copies >= 2, V(M) > 0.
double stackability_within(const Stackability& measured, int copies, double length);

/// From a wish to numbers, for a shape measured along r (StackabilitySolver::measure or stackability()) with
/// the clearance and play that the copies keep. Lengths are compared within tolerance::relative of L, in
/// favour of the shape. Throws UsageError on wishes outside their ranges.
StackPlan plan_stack(const Stackability& measured, const StackRequest& wish);

}  // namespace stackabilization
