#include "numerics/constrained_least_squares.h"

#include <Eigen/SparseCholesky>
#include <cmath>
#include <utility>

namespace stackabilization::detail {

namespace {

/// Penalty of a constraint relative to terms of weight 1: large enough for fast convergence, small enough for
/// accuracy.
constexpr double penalty = 1 << 20;
constexpr int max_multiplier_steps = 60;

}  // namespace

void ConstrainedLeastSquares::add_soft(const Row& row, double right, double weight) {
  const double factor = std::sqrt(weight);
  for (const Term& term : row)
    soft_rows_.triplets.emplace_back(static_cast<int>(soft_rows_.right.size()), term.variable,
                                     factor * term.factor);
  soft_rows_.right.push_back(factor * right);
}

void ConstrainedLeastSquares::add_equality(const Row& row, double right) {
  for (const Term& term : row)
    equalities_.triplets.emplace_back(static_cast<int>(equalities_.right.size()), term.variable, term.factor);
  equalities_.right.push_back(right);
}

ConstrainedLeastSquares::Matrices ConstrainedLeastSquares::reduced(const Rows& rows,
                                                                   const std::vector<int>& column,
                                                                   int columns) const {
  Matrices out;
  out.right =
      Eigen::Map<const Eigen::VectorXd>(rows.right.data(), static_cast<Eigen::Index>(rows.right.size()));
  std::vector<Eigen::Triplet<double>> free;
  for (const auto& entry : rows.triplets) {
    const auto variable = static_cast<std::size_t>(entry.col());
    if (fixed_[variable])
      out.right(entry.row()) -= entry.value() * *fixed_[variable];
    else
      free.emplace_back(entry.row(), column[variable], entry.value());
  }
  out.matrix.resize(out.right.size(), columns);
  out.matrix.setFromTriplets(free.begin(), free.end());
  return out;
}

ConstrainedLeastSquares::Solution ConstrainedLeastSquares::solve(double resolution) const {
  std::vector<int> column(fixed_.size(), -1);
  int columns = 0;
  for (std::size_t v = 0; v < fixed_.size(); ++v)
    if (!fixed_[v]) column[v] = columns++;
  const Matrices soft_rows = reduced(soft_rows_, column, columns),
                 equalities = reduced(equalities_, column, columns);
  const Eigen::SparseMatrix<double> a = soft_rows.matrix.transpose(), c = equalities.matrix.transpose();
  const Eigen::SimplicialLDLT<Eigen::SparseMatrix<double>> factor(a * soft_rows.matrix +
                                                                  penalty * (c * equalities.matrix));
  Eigen::VectorXd x = Eigen::VectorXd::Zero(columns);
  Eigen::VectorXd multipliers = Eigen::VectorXd::Zero(equalities.right.size());
  Eigen::VectorXd residual = -equalities.right;
  for (int step = 0; step < max_multiplier_steps && columns > 0; ++step) {
    const Eigen::VectorXd gradient =
        a * (soft_rows.matrix * x - soft_rows.right) + c * (multipliers + penalty * residual);
    const Eigen::VectorXd change = factor.solve(gradient);
    x -= change;
    residual = equalities.matrix * x - equalities.right;
    multipliers += penalty * residual;
    if (change.cwiseAbs().maxCoeff() <= resolution) break;
  }
  Solution solution;
  solution.values.resize(static_cast<Eigen::Index>(fixed_.size()));
  for (std::size_t v = 0; v < fixed_.size(); ++v)
    solution.values(static_cast<Eigen::Index>(v)) = fixed_[v] ? *fixed_[v] : x(column[v]);
  solution.residual = std::move(residual);
  return solution;
}

}  // namespace stackabilization::detail
