#include <cmath>
#include <limits>
#include <vector>

#include "common/statistics.h"
#include "support/catch.h"

using namespace stackabilization::experiments;

namespace {

/// Errors factor * n^-order at 32, 64 ... 4096.
std::vector<Eigen::Vector2d> errors_of_order(double order, double factor) {
  std::vector<Eigen::Vector2d> points;
  for (int n = 32; n <= 4096; n *= 2) points.emplace_back(n, factor * std::pow(n, -order));
  return points;
}

}  // namespace

TEST_CASE("the order of convergence of a known law is found") {
  for (const double order : {0.5, 1.0, 2.0, 3.7})
    for (const double factor : {1e-3, 1.0, 250.0})
      CHECK(order_of_convergence(errors_of_order(order, factor)).value() == Approx(order).epsilon(1e-12));
}

TEST_CASE("the order does not depend on the unit of the resolution, nor on that of the error") {
  std::vector<Eigen::Vector2d> points = {{32, 0.1}, {64, 0.07}, {128, 0.01}, {256, 0.006}};
  const double order = order_of_convergence(points).value();
  for (Eigen::Vector2d& point : points) point = Eigen::Vector2d(25.4 * point.x(), 1e3 * point.y());
  CHECK(order_of_convergence(points).value() == Approx(order).epsilon(1e-12));
}

TEST_CASE("noise that is even in the logarithm does not move the order") {
  std::vector<Eigen::Vector2d> points = {{1, 2}, {10, 0.05}, {100, 0.005}, {1000, 0.002}};  // 2^(+-1) x^-1
  points[1].y() = 0.1 / 2;
  points[2].y() = 0.01 / 2;
  CHECK(order_of_convergence(points).value() == Approx(1).epsilon(1e-12));
}

TEST_CASE("errors at the floor of a method's precision do not flatten its order") {
  std::vector<Eigen::Vector2d> points = errors_of_order(2, 1);
  for (Eigen::Vector2d& point : points) point.y() = std::max(point.y(), 1e-5);
  CHECK(order_of_convergence(points).value() < 1.9);
  CHECK(order_of_convergence(points, 1e-5).value() == Approx(2).epsilon(1e-12));
}

TEST_CASE("no order is made up where there is none") {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  CHECK_FALSE(order_of_convergence({}));
  CHECK_FALSE(order_of_convergence({{32, 0.1}}));
  CHECK_FALSE(order_of_convergence({{32, 0.1}, {32, 0.2}, {32, 0.4}}));
  CHECK_FALSE(order_of_convergence({{32, 0.1}, {64, 0}, {128, nan}}));
  CHECK(order_of_convergence({{32, 0.1}, {48, 0}, {64, 0.05}}).value() == Approx(1));
}

TEST_CASE("a power law gives its factor too") {
  const PowerLaw law = power_law({{1, 3}, {2, 12}, {4, 48}}).value();
  CHECK(law.exponent == Approx(2));
  CHECK(law.factor == Approx(3));
}

TEST_CASE("quantiles are values of the list that enough others do not exceed") {
  CHECK(median({3, 1, 2}) == 2);
  CHECK(median({4, 1, 3, 2}) == 2);
  CHECK(median({7}) == 7);
  const std::vector<double> values = {10, 9, 8, 7, 6, 5, 4, 3, 2, 1};
  CHECK(quantile(values, 0.9) == 9);
  CHECK(quantile(values, 0.91) == 10);
  CHECK(quantile(values, 1) == 10);
  CHECK(quantile(values, 0.01) == 1);
}
