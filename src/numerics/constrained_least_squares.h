#pragma once

#include <Eigen/Core>
#include <Eigen/SparseCore>
#include <optional>
#include <vector>

/// Not installed.
namespace stackabilization::detail {

/// Sparse linear least squares under linear equations, which may repeat or contradict one another: the method
/// of multipliers (Hestenes 1969), one factorization of the penalised normal equations for all
/// its steps.
class ConstrainedLeastSquares {
 public:
  struct Term {
    int variable;
    double factor;
  };
  using Row = std::vector<Term>;

  struct Solution {
    Eigen::VectorXd values;  ///< one per variable
    /// Row - right side, one per equation: rounding, unless they contradict one another; then the sum of
    /// their squares is least.
    Eigen::VectorXd residual;
  };

  /// Weights of wishes should be near 1, or below.
  explicit ConstrainedLeastSquares(int variables) : fixed_(static_cast<std::size_t>(variables)) {}

  void add_soft(const Row& row, double right, double weight);
  void add_equality(const Row& row, double right);
  void fix(int variable, double value) { fixed_[static_cast<std::size_t>(variable)] = value; }

  /// `resolution`: change of the variables below which steps end. Precondition: wishes and equations together
  /// determine every variable.
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
