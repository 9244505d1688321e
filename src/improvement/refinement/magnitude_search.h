#pragma once

#include "improvement/refinement/magnitude_problem.h"
#include "stackabilization/improvement/refinement.h"

namespace stackabilization::detail {

/// Searches the feasible magnitudes of least change with few edits, starting from `given`. The result is
/// MagnitudeProblem::best(). If there is no feasible point, MagnitudeProblem::nearest() has the largest S
/// found. Precondition: the design of `given` can be made.
void search_magnitudes(MagnitudeProblem& problem, const Magnitudes& given, const RefinementOptions& options);

}  // namespace stackabilization::detail
