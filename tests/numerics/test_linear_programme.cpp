#include <Eigen/LU>
#include <algorithm>
#include <cstdint>
#include <optional>

#include "numerics/linear_programme.h"
#include "random_numbers.h"
#include "support/catch.h"

using namespace stackabilization;
using namespace stackabilization::detail;

namespace {

/// Tries every basis of two columns: the fundamental theorem of linear programming.
std::optional<double> best_of_all_bases(const LinearProgramme& programme) {
  std::optional<double> best;
  for (Eigen::Index i = 0; i < programme.a.cols(); ++i)
    for (Eigen::Index j = i + 1; j < programme.a.cols(); ++j) {
      Eigen::Matrix2d basis;
      basis << programme.a.col(i), programme.a.col(j);
      const Eigen::Vector2d x = basis.inverse() * programme.b;
      if (!(x.minCoeff() >= 0)) continue;
      const double value = x.x() * programme.c(i) + x.y() * programme.c(j);
      best = std::max(best.value_or(value), value);
    }
  return best;
}

}  // namespace

TEST_CASE("a linear programme has the value of its best basis") {
  int feasible = 0;
  for (std::uint32_t seed = 1; seed <= 60; ++seed) {
    test::RandomNumbers number(seed);
    const LinearProgramme programme = {number.matrix(2, 7), number.matrix(2, 1),
                                       number.matrix(7, 1).array() - 1};
    // All costs are negative: there is no way to infinity.
    const LinearMaximum found = maximize(programme);
    const auto expected = best_of_all_bases(programme);
    REQUIRE((found.outcome == LinearOutcome::optimum) == expected.has_value());
    if (!expected) continue;
    ++feasible;
    CHECK(found.value == Approx(*expected));
    CHECK(found.value == Approx(programme.c.dot(found.x)));
    CHECK(found.x.minCoeff() >= 0);
    CHECK((programme.a * found.x - programme.b).norm() < 1e-12);
  }
  CHECK(feasible > 20);
  CHECK(feasible < 60);
}

TEST_CASE("a linear programme may have no end, or no solution") {
  // x - y = 1: x as large, and as small, as it may be.
  LinearProgramme programme = {Eigen::RowVector2d(1, -1), Eigen::VectorXd::Ones(1), Eigen::Vector2d(1, 0)};
  CHECK(maximize(programme).outcome == LinearOutcome::unbounded);
  programme.c = -programme.c;
  CHECK(maximize(programme).outcome == LinearOutcome::optimum);
  CHECK(maximize(programme).x == Eigen::Vector2d(1, 0));
  programme.a = Eigen::RowVector2d(-1, -1);
  CHECK(maximize(programme).outcome == LinearOutcome::infeasible);
}

TEST_CASE("a linear programme is decided for the doubles that were given") {
  // x + y = 0.3 and x = 0.1 leave y = 0.2 less a little, which 10 (x + y) + z = 3 shows.
  LinearProgramme programme = {Eigen::MatrixXd(2, 3), Eigen::Vector2d(0.3, 3), Eigen::Vector3d::Zero()};
  programme.a << 1, 1, 0, 10, 10, 1;
  const LinearMaximum found = maximize(programme);
  REQUIRE(found.outcome == LinearOutcome::optimum);
  CHECK(found.x(2) == Approx(1.1102230246251565e-16).epsilon(1e-12));  // 3 - 10 * 0.3 as it is stored
  programme.b(0) = 0.3 + 0x1p-54;
  CHECK(maximize(programme).outcome == LinearOutcome::infeasible);
}
