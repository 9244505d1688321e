#pragma once

#include <Eigen/Core>

namespace stackabilization::detail {

/// min 1/2 x^T Q x + c^T x subject to A x <= b.
struct QuadraticProgramme {
  Eigen::MatrixXd q;  ///< n x n, symmetric and positive semi-definite
  Eigen::VectorXd c;  ///< n
  Eigen::MatrixXd a;  ///< m x n, m > 0; between them the rows bound every x in all directions
  Eigen::VectorXd b;  ///< m
};

/// Where it is least.
struct QuadraticMinimum {
  Eigen::VectorXd x;
  Eigen::VectorXd multipliers;  ///< m, >= 0: how fast the minimum falls as the row's b grows
};

/// Its minimum, by Mehrotra's predictor-corrector interior-point method (Mehrotra 1992; Nocedal and Wright
/// 2006, Algorithm 16.4), dense: for up to some hundreds of variables and rows, of which any number may
/// repeat or depend on each other. Numbers are best of the order of 1. Where nothing satisfies all rows, some
/// point that violates them little. Deterministic.
QuadraticMinimum minimize(const QuadraticProgramme& programme);

}  // namespace stackabilization::detail
