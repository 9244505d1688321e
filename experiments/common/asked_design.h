#pragma once

#include <string>

#include "stackabilization/core/direction.h"
#include "stackabilization/improvement/improve.h"
#include "stackabilization/structure/structure.h"

namespace stackabilization::experiments {

/// What `improve` answers to a wish with the height kept, every limit of quality at its default, no clock.
struct AskedDesign {
  Improvement found;
  Candidate best;             ///< first solution, or nearest design, or the shape at rest
  std::string measure;        ///< the measure of quality of `best` that uses most of its limit
  double share_of_limit = 0;  ///< and the share
  double change = 0;          ///< root mean square displacement of `best`, over the diagonal
  double first_seconds = 0;   ///< until the first acceptable design that reaches the target; 0 without one
  double seconds = 0;

  bool reached() const { return !found.solutions.empty(); }
  /// Returns what holds the nearest design, and what helps first, in sentences; "" where nothing is known.
  std::string why(const Structure& structure) const;
  std::string remedy(const Structure& structure) const;
};

/// Asks for S of at least `target` along `direction` with the work of `effort`.
AskedDesign ask_for_design(const StructuredShape& model, const Direction& direction, double target,
                           double effort);

}  // namespace stackabilization::experiments
