#include "numerics/linear_programme.h"

#include <CGAL/Gmpzf.h>
#include <CGAL/QP_functions.h>
#include <CGAL/QP_models.h>

namespace stackabilization::detail {

LinearMaximum maximize(const LinearProgramme& programme) {
  CGAL::Quadratic_program<double> exact(CGAL::EQUAL, true, 0, false, 0);
  const auto columns = static_cast<int>(programme.a.cols()), rows = static_cast<int>(programme.a.rows());
  for (int row = 0; row < rows; ++row) exact.set_b(row, programme.b(row));
  for (int column = 0; column < columns; ++column) {
    for (int row = 0; row < rows; ++row) exact.set_a(column, row, programme.a(row, column));
    exact.set_c(column, -programme.c(column));
  }
  const CGAL::Quadratic_program_solution<CGAL::Gmpzf> solution =
      CGAL::solve_nonnegative_linear_program(exact, CGAL::Gmpzf());
  LinearMaximum result;
  if (solution.is_infeasible()) return result;
  if (solution.is_unbounded()) {
    result.outcome = LinearOutcome::unbounded;
    return result;
  }
  result.outcome = LinearOutcome::optimum;
  result.value = -CGAL::to_double(solution.objective_value());
  result.x.resize(columns);
  Eigen::Index column = 0;
  for (auto value = solution.variable_values_begin(); value != solution.variable_values_end(); ++value)
    result.x(column++) = CGAL::to_double(*value);
  return result;
}

}  // namespace stackabilization::detail
