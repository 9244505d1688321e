#pragma once

#include <Eigen/Core>

namespace stackabilization::detail {

/// The convex quadratic programme: minimise 1/2 x^T Q x + c^T x subject to A x <= b.
struct QuadraticProgramme {
  Eigen::MatrixXd q;  ///< n x n, symmetric and positive semi-definite
  Eigen::VectorXd c;  ///< n
  /// m x n, m > 0. Together the rows bound x in every direction.
  Eigen::MatrixXd a;
  Eigen::VectorXd b;  ///< m
};

/// Solution of a quadratic programme.
struct QuadraticMinimum {
  Eigen::VectorXd x;  ///< n, the minimiser
  /// m Lagrange multipliers, >= 0: the rate at which the minimum decreases when the entry of b increases.
  Eigen::VectorXd multipliers;
};

/// Solves a quadratic programme with Mehrotra's predictor-corrector interior-point method (Mehrotra 1992;
/// Nocedal and Wright 2006, Algorithm 16.4). The matrices are dense; the method suits up to some hundred
/// variables and rows. Rows may repeat or depend on each other. Entries of the order of 1 give the best
/// accuracy. When no x satisfies all rows, the result is a point with small violations. Deterministic.
QuadraticMinimum minimize(const QuadraticProgramme& programme);

}  // namespace stackabilization::detail
