#pragma once

#include <Eigen/Core>

namespace stackabilization::detail {

/// The linear programme: maximise c^T x subject to A x = b and x >= 0.
struct LinearProgramme {
  Eigen::MatrixXd a;  ///< m x n
  Eigen::VectorXd b;  ///< m
  Eigen::VectorXd c;  ///< n
};

/// What a linear programme has.
enum class LinearOutcome { optimum, infeasible, unbounded };

/// Solution of a linear programme.
struct LinearMaximum {
  LinearOutcome outcome = LinearOutcome::infeasible;
  double value = 0;   ///< c^T x, of an optimum
  Eigen::VectorXd x;  ///< n, of an optimum
};

/// Solves a linear programme with CGAL's simplex method, in exact arithmetic on the given doubles: what is
/// infeasible by rounding only is infeasible. For few rows and up to some ten thousand columns.
/// Deterministic. Precondition: b is no combination of fewer than m columns, as for entries in general
/// position; otherwise the method may go round in circles for ever.
LinearMaximum maximize(const LinearProgramme& programme);

}  // namespace stackabilization::detail
