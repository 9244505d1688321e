#pragma once

#include <Eigen/Core>
#include <Eigen/SparseCore>
#include <optional>
#include <vector>

namespace stackabilization::detail {

/// Sparse linear least squares under linear equality constraints, by the method of multipliers (Hestenes
/// 1969). All steps share one factorization of the penalised normal equations. Constraints may be redundant
/// or contradictory.
class ConstrainedLeastSquares {
 public:
  /// A variable with its coefficient.
  struct Term {
    int variable;
    double factor;
  };
  /// A linear form: the sum of its terms.
  using Row = std::vector<Term>;

  /// Result of `solved`.
  struct Solution {
    Eigen::VectorXd values;  ///< one per variable
    /// Residuals (row - right side), one per constraint. They are rounding errors for compatible constraints;
    /// for contradictory constraints the sum of their squares is minimal.
    Eigen::VectorXd residual;
  };

  /// Creates a problem without terms and constraints. `variables`: number of variables.
  explicit ConstrainedLeastSquares(int variables) : fixed_(static_cast<std::size_t>(variables)) {}

  /// Adds the term `weight` * (row - right)^2 to the objective. Weights should be about 1 or smaller.
  void add_soft(const Row& row, double right, double weight);
  /// Adds the constraint row = right.
  void add_equality(const Row& row, double right);
  /// Sets a variable to a value and removes it from the problem.
  void fix(int variable, double value) { fixed_[static_cast<std::size_t>(variable)] = value; }

  /// Solves the problem. The steps end when the variables change by less than `resolution`. Precondition:
  /// terms and constraints together determine every variable.
  Solution solve(double resolution) const;

 private:
  struct Rows {
    std::vector<Eigen::Triplet<double>> triplets;
    std::vector<double> right;
  };
  struct Matrices {
    Eigen::SparseMatrix<double> matrix;
    Eigen::VectorXd right;
  };

  Matrices reduced(const Rows& rows, const std::vector<int>& column, int columns) const;

  std::vector<std::optional<double>> fixed_;
  Rows soft_rows_, equalities_;
};

}  // namespace stackabilization::detail
