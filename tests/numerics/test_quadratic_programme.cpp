#include <cstdint>

#include "numerics/quadratic_programme.h"
#include "random_numbers.h"
#include "support/catch.h"

using namespace stackabilization;
using namespace stackabilization::detail;

namespace {

QuadraticProgramme in_a_box(Eigen::Index n, double size) {
  QuadraticProgramme programme{Eigen::MatrixXd::Zero(n, n), Eigen::VectorXd::Zero(n),
                               Eigen::MatrixXd::Zero(2 * n, n), Eigen::VectorXd::Constant(2 * n, size)};
  programme.a << Eigen::MatrixXd::Identity(n, n), -Eigen::MatrixXd::Identity(n, n);
  return programme;
}

void add_rows(QuadraticProgramme& programme, const Eigen::MatrixXd& a, const Eigen::VectorXd& b) {
  Eigen::MatrixXd all(programme.a.rows() + a.rows(), a.cols());
  all << programme.a, a;
  Eigen::VectorXd bounds(all.rows());
  bounds << programme.b, b;
  programme.a = all;
  programme.b = bounds;
}

/// The conditions of Karush, Kuhn and Tucker, which are sufficient for a convex programme.
void check_minimum(const QuadraticProgramme& programme, const QuadraticMinimum& found) {
  const Eigen::VectorXd left = programme.b - programme.a * found.x;
  CHECK(left.minCoeff() >= -1e-8);
  CHECK(found.multipliers.minCoeff() >= 0);
  CHECK(found.multipliers.cwiseProduct(left).cwiseAbs().maxCoeff() <= 1e-7);
  const Eigen::VectorXd slope =
      programme.q * found.x + programme.c + programme.a.transpose() * found.multipliers;
  CHECK(slope.cwiseAbs().maxCoeff() <= 1e-8);
}

}  // namespace

TEST_CASE("minima of random convex programmes satisfy the conditions for one") {
  for (std::uint32_t seed = 1; seed <= 40; ++seed) {
    test::RandomNumbers number(seed);
    const Eigen::Index n = 1 + seed % 12, rank = seed % (n + 1);
    QuadraticProgramme programme = in_a_box(n, 1);
    const Eigen::MatrixXd factor = number.matrix(rank, n);
    programme.q = factor.transpose() * factor;
    programme.c = number.matrix(n, 1);
    // Half-spaces that contain the origin, every one of them twice.
    const Eigen::MatrixXd rows = number.matrix(2 * n, n);
    const Eigen::VectorXd bounds = number.matrix(2 * n, 1).cwiseAbs() / 4;
    add_rows(programme, rows, bounds);
    add_rows(programme, rows, bounds);
    check_minimum(programme, minimize(programme));
  }
}

TEST_CASE("multipliers say how fast a minimum falls when a bound gives way") {
  // min (x - 2)^2 / 2 with x <= 0.5: the slope is 1.5.
  QuadraticProgramme programme = in_a_box(1, 1);
  programme.q(0, 0) = 1;
  programme.c(0) = -2;
  programme.b(0) = 0.5;
  const QuadraticMinimum found = minimize(programme);
  CHECK(found.x(0) == Approx(0.5).epsilon(1e-8));
  CHECK(found.multipliers(0) == Approx(1.5).epsilon(1e-7));
  CHECK(found.multipliers(1) == Approx(0).margin(1e-8));
}

TEST_CASE("bounds of zero width leave nothing to choose") {
  QuadraticProgramme programme = in_a_box(2, 1);
  programme.c << -1, -1;
  programme.b(0) = programme.b(2) = 0;
  const QuadraticMinimum found = minimize(programme);
  CHECK(found.x(0) == Approx(0).margin(1e-6));
  CHECK(found.x(1) == Approx(1).epsilon(1e-6));
}

TEST_CASE("contradictory rows end in a point that is finite") {
  QuadraticProgramme programme = in_a_box(2, 1);
  add_rows(programme, Eigen::RowVector2d(1, 1), Eigen::VectorXd::Constant(1, -3));
  const QuadraticMinimum found = minimize(programme);
  CHECK(found.x.allFinite());
  CHECK(found.multipliers.allFinite());
}
