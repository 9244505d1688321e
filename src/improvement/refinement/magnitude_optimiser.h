#pragma once

#include "improvement/refinement/magnitude_model.h"

namespace stackabilization::detail {

/// Where a run of the optimiser begins, and what for.
struct MagnitudeRun {
  Magnitudes start;
  MagnitudeGoal goal = MagnitudeGoal::unchanged;
};

/// Goes on to a local optimum; where it ended, which need not be the best point on its way (see
/// MagnitudeProblem::best).
///
/// A bundle method in a trust region: S is a maximum over contacts, so its slopes jump wherever another
/// contact takes over, and sequential quadratic programming, which believes in the slopes at one point, gets
/// stuck there. What is seen from points that failed is kept as cuts (MagnitudeModel), and the next step
/// knows of both contacts. Precondition: the start can be made, and is feasible unless that is the goal.
Magnitudes optimised_magnitudes(MagnitudeProblem& problem, const MagnitudeRun& run);

}  // namespace stackabilization::detail
