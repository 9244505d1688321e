#pragma once

#include "improvement/refinement/magnitude_problem.h"
#include "stackabilization/improvement/refinement.h"

namespace stackabilization::detail {

/// Looks for the feasible magnitudes of least change, and of few edits, from those given: afterwards they are
/// the best ones of `problem`. Where none is found the nearest ones are those of largest S that were met.
/// Precondition: what is given can be made.
void search_magnitudes(MagnitudeProblem& problem, const Magnitudes& given, const RefinementOptions& options);

}  // namespace stackabilization::detail
