#include <Eigen/Dense>
#include <cstdint>

#include "numerics/constrained_least_squares.h"
#include "random_numbers.h"
#include "support/catch.h"

namespace stackabilization::constrained_least_squares_test {

using namespace detail;
using Row = ConstrainedLeastSquares::Row;
using Solution = ConstrainedLeastSquares::Solution;

namespace {

constexpr double resolution = 1e-13;

Row row_of(const Eigen::RowVectorXd& factors) {
  Row row;
  for (Eigen::Index k = 0; k < factors.size(); ++k) row.push_back({static_cast<int>(k), factors(k)});
  return row;
}

void wish_all(ConstrainedLeastSquares& problem, const Eigen::MatrixXd& a, const Eigen::VectorXd& right) {
  for (Eigen::Index k = 0; k < a.rows(); ++k) problem.add_soft(row_of(a.row(k)), right(k), 1);
}

void demand_all(ConstrainedLeastSquares& problem, const Eigen::MatrixXd& c, const Eigen::VectorXd& right) {
  for (Eigen::Index k = 0; k < c.rows(); ++k) problem.add_equality(row_of(c.row(k)), right(k));
}

}  // namespace

TEST_CASE("the point of a plane nearest to a given one is its foot") {
  const Eigen::Vector3d normal(1, 2, -2), given(0.5, -0.25, 1);
  ConstrainedLeastSquares problem(3);
  for (int k = 0; k < 3; ++k) problem.add_soft({{k, 1}}, given(k), 1);
  problem.add_equality(row_of(normal.transpose()), 3);
  const Solution found = problem.solve(resolution);
  const Eigen::Vector3d foot = given + (3 - normal.dot(given)) / normal.squaredNorm() * normal;
  CHECK((found.values - foot).norm() < 1e-12);
  CHECK(std::abs(found.residual(0)) < 1e-12);
}

TEST_CASE("weights of wishes draw their mean") {
  ConstrainedLeastSquares problem(1);
  problem.add_soft({{0, 1}}, 0, 0.25);
  problem.add_soft({{0, 1}}, 1, 0.75);
  CHECK(problem.solve(resolution).values(0) == Approx(0.75).epsilon(1e-12));
}

TEST_CASE("random problems satisfy the conditions of Lagrange") {
  for (std::uint32_t seed = 1; seed <= 30; ++seed) {
    test::RandomNumbers number(seed);
    const Eigen::Index n = 3 + seed % 8, equations = 1 + seed % (n - 1);
    const Eigen::MatrixXd a = number.matrix(n + 3, n), c = number.matrix(equations, n);
    const Eigen::VectorXd wished = number.matrix(n + 3, 1), demanded = number.matrix(equations, 1);
    ConstrainedLeastSquares problem(static_cast<int>(n));
    wish_all(problem, a, wished);
    demand_all(problem, c, demanded);
    const Solution found = problem.solve(resolution);
    CHECK((c * found.values - demanded).norm() < 1e-9);
    // The gradient is a combination of the equations: nothing of it lies in their null space.
    const Eigen::VectorXd gradient = a.transpose() * (a * found.values - wished);
    const Eigen::MatrixXd free = c.fullPivLu().kernel();
    CHECK((free.transpose() * gradient).norm() < 1e-8);
  }
}

TEST_CASE("equations that repeat or follow from others change nothing") {
  test::RandomNumbers number(7);
  const Eigen::MatrixXd c = number.matrix(2, 5);
  const Eigen::VectorXd demanded = number.matrix(2, 1), wished = number.matrix(5, 1);
  ConstrainedLeastSquares once(5), again(5);
  for (ConstrainedLeastSquares* problem : {&once, &again}) {
    wish_all(*problem, Eigen::MatrixXd::Identity(5, 5), wished);
    demand_all(*problem, c, demanded);
  }
  demand_all(again, c, demanded);
  again.add_equality(row_of(c.row(0) - 2 * c.row(1)), demanded(0) - 2 * demanded(1));
  CHECK((once.solve(resolution).values - again.solve(resolution).values).norm() < 1e-11);
  CHECK(again.solve(resolution).residual.size() == 5);
  CHECK(again.solve(resolution).residual.norm() < 1e-10);
}

TEST_CASE("equations that contradict each other miss with the least sum of squares") {
  ConstrainedLeastSquares problem(2);
  problem.add_soft({{0, 1}}, 5, 1);
  problem.add_soft({{1, 1}}, 5, 1);
  for (const double right : {0.0, 1.0, 5.0}) problem.add_equality({{0, 1}}, right);
  const Solution found = problem.solve(resolution);
  CHECK(found.values(0) == Approx(2).epsilon(1e-6));
  CHECK(found.values(1) == Approx(5).epsilon(1e-12));
  CHECK((found.residual - Eigen::Vector3d(2, 1, -3)).norm() < 1e-5);
}

TEST_CASE("fixed variables keep their value to the last bit and leave the others to the rest") {
  ConstrainedLeastSquares problem(3);
  for (int k = 0; k < 3; ++k) problem.add_soft({{k, 1}}, 0, 1);
  problem.add_equality({{0, 1}, {1, 1}, {2, 1}}, 3);
  problem.fix(1, 0.1);
  const Solution found = problem.solve(resolution);
  CHECK(found.values(1) == 0.1);
  CHECK(found.values(0) == Approx(1.45).epsilon(1e-12));
  CHECK(found.values(2) == Approx(1.45).epsilon(1e-12));
}

TEST_CASE("with every variable fixed the equations tell by how much they miss") {
  ConstrainedLeastSquares problem(2);
  problem.add_equality({{0, 1}, {1, -1}}, 1);
  problem.fix(0, 4);
  problem.fix(1, 1);
  const Solution found = problem.solve(resolution);
  CHECK(found.values == Eigen::Vector2d(4, 1));
  CHECK(found.residual(0) == Approx(2).epsilon(1e-14));
}

}  // namespace stackabilization::constrained_least_squares_test
