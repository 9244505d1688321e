#include "numerics/constrained_least_squares.h"

#include <Eigen/SparseCholesky>
#include <cmath>
#include <utility>

namespace stackabilization::detail {

namespace {

/// Penalty of a demand against wishes of weight 1: large enough for a few steps, small enough for the digits.
constexpr double penalty = 1 << 20;
constexpr int max_multiplier_steps = 60;

}  // namespace

void ConstrainedLeastSquares::wish(const Row& row, double right, double weight) {
  const double factor = std::sqrt(weight);
  for (const Term& term : row)
    wishes_.triplets.emplace_back(static_cast<int>(wishes_.right.size()), term.variable,
                                  factor * term.factor);
  wishes_.right.push_back(factor * right);
}

void ConstrainedLeastSquares::demand(const Row& row, double right) {
  for (const Term& term : row)
    demands_.triplets.emplace_back(static_cast<int>(demands_.right.size()), term.variable, term.factor);
  demands_.right.push_back(right);
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

ConstrainedLeastSquares::Solution ConstrainedLeastSquares::solved(double resolution) const {
  std::vector<int> column(fixed_.size(), -1);
  int columns = 0;
  for (std::size_t v = 0; v < fixed_.size(); ++v)
    if (!fixed_[v]) column[v] = columns++;
  const Matrices wishes = reduced(wishes_, column, columns), demands = reduced(demands_, column, columns);
  const Eigen::SparseMatrix<double> a = wishes.matrix.transpose(), c = demands.matrix.transpose();
  const Eigen::SimplicialLDLT<Eigen::SparseMatrix<double>> factor(a * wishes.matrix +
                                                                  penalty * (c * demands.matrix));
  Eigen::VectorXd x = Eigen::VectorXd::Zero(columns);
  Eigen::VectorXd multipliers = Eigen::VectorXd::Zero(demands.right.size());
  Eigen::VectorXd missed = -demands.right;
  for (int step = 0; step < max_multiplier_steps && columns > 0; ++step) {
    const Eigen::VectorXd gradient =
        a * (wishes.matrix * x - wishes.right) + c * (multipliers + penalty * missed);
    const Eigen::VectorXd change = factor.solve(gradient);
    x -= change;
    missed = demands.matrix * x - demands.right;
    multipliers += penalty * missed;
    if (change.cwiseAbs().maxCoeff() <= resolution) break;
  }
  Solution solution;
  solution.values.resize(static_cast<Eigen::Index>(fixed_.size()));
  for (std::size_t v = 0; v < fixed_.size(); ++v)
    solution.values(static_cast<Eigen::Index>(v)) = fixed_[v] ? *fixed_[v] : x(column[v]);
  solution.missed = std::move(missed);
  return solution;
}

}  // namespace stackabilization::detail
