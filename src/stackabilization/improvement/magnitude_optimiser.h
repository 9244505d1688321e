#pragma once

#include "stackabilization/improvement/magnitude_problem.h"

namespace stackabilization::detail {

enum class MagnitudeGoal {
  feasible,   ///< the largest shortfall is made as small as can be, until a sample is feasible
  unchanged,  ///< D is made as small as can be while no constraint falls short
};

/// Goes on from `start` to a local optimum by sequential quadratic programming (NLopt's SLSQP; Kraft 1994),
/// with extra variables for the largest shortfall or the magnitude of each change of D, so that all it sees
/// is smooth. Returns where it ended, which need not be the best point on its way (see
/// MagnitudeProblem::best), nor quite feasible. Precondition: at(start).made.
Magnitudes optimised_magnitudes(MagnitudeProblem& problem, const Magnitudes& start, MagnitudeGoal goal);

}  // namespace stackabilization::detail
