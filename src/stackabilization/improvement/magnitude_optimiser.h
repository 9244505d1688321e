#pragma once

#include "stackabilization/improvement/magnitude_problem.h"

namespace stackabilization::detail {

enum class MagnitudeGoal {
  feasible,   ///< the largest shortfall is made as small as can be, until a sample is feasible
  unchanged,  ///< D is made as small as can be while no constraint falls short
};

/// Where a run of the optimiser begins, and how far it may go.
struct MagnitudeRun {
  Magnitudes start;
  double radius = 0;  ///< no magnitude changes by more, > 0
  MagnitudeGoal goal = MagnitudeGoal::unchanged;
};

/// Where it ended, which need not be the best point on its way (see MagnitudeProblem::best), nor feasible.
struct MagnitudeRunEnd {
  Magnitudes end;
  bool refused = false;  ///< it met edits that are refused
};

/// Goes on to a local optimum by sequential quadratic programming (NLopt's SLSQP; Kraft 1994), with extra
/// variables for the largest shortfall or the magnitude of each change of D, so that all it sees is smooth.
/// Precondition: the start can be made.
MagnitudeRunEnd optimised_magnitudes(MagnitudeProblem& problem, const MagnitudeRun& run);

}  // namespace stackabilization::detail
