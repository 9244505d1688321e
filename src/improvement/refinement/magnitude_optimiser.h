#pragma once

#include "improvement/refinement/magnitude_model.h"

namespace stackabilization::detail {

/// Start and objective of a run of the optimiser.
struct MagnitudeRun {
  Magnitudes start;
  MagnitudeGoal goal = MagnitudeGoal::min_change;
};

/// Runs a bundle method in a trust region to a local optimum. Returns the last point accepted, which need not
/// be the best point visited (see MagnitudeProblem::best).
///
/// f_max is a maximum over contacts, so slopes jump wherever another contact becomes critical. Sequential
/// quadratic programming trusts the slopes at one point and gets stuck there. This method keeps the
/// linearisations at rejected points as cuts (MagnitudeModel), so the next step accounts for both contacts.
/// Precondition: the design of the start can be made, and is feasible unless feasibility is the goal.
Magnitudes optimise_magnitudes(MagnitudeProblem& problem, const MagnitudeRun& run);

}  // namespace stackabilization::detail
