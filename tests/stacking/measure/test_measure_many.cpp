#include <tbb/global_control.h>

#include <limits>

#include "stackabilization/core/errors.h"
#include "stackabilization/stacking/measure_many.h"
#include "support/catch.h"
#include "support/solids.h"

using namespace stackabilization;

namespace {

/// k directions around the z axis, no two alike and of different lengths.
Points fan(Eigen::Index k) {
  Points rows(k, 3);
  for (Eigen::Index i = 0; i < k; ++i) {
    const auto x = static_cast<double>(i);
    rows.row(i) << x, -0.5 * x, 100 + x;
  }
  return rows;
}

}  // namespace

TEST_CASE("many directions are measured as each of them, in their order, by any number of threads") {
  const StackabilitySolver solver(solids::frustum_shell({.segments = 8}));
  const Points asked = fan(600);
  for (const std::size_t threads : {1, 4}) {
    const tbb::global_control control(tbb::global_control::max_allowed_parallelism, threads);
    const std::vector<Stackability> measured = measure_many(solver, asked);
    REQUIRE(measured.size() == 600);
    for (std::size_t i = 0; i < measured.size(); i += 7) {
      const Direction direction(asked.row(static_cast<Eigen::Index>(i)).transpose());
      CHECK(measured[i].direction == direction.vector());
      CHECK(measured[i].value == solver.measure(direction).value);
      CHECK(measured[i].f_max == solver.measure(direction).f_max);
    }
  }
}

TEST_CASE("a measurement of many directions that is cancelled has the first of them") {
  const StackabilitySolver solver(solids::box({1, 2, 3}));
  const Points asked = fan(2000);
  std::vector<double> told;
  int questions = 0;
  MeasureManyOptions options;
  options.progress = [&](double fraction) { told.push_back(fraction); };
  options.cancelled = [&] { return ++questions > 2; };
  const std::vector<Stackability> measured = measure_many(solver, asked, options);
  REQUIRE(measured.size() == 1024);
  CHECK(measured.back().direction == Eigen::Vector3d(asked.row(1023).transpose()));
  CHECK(told == std::vector<double>{0, 512.0 / 2000});
}

TEST_CASE("a row that is no direction is named before anything is measured") {
  const StackabilitySolver solver(solids::box({1, 2, 3}));
  for (const double bad : {0.0, std::numeric_limits<double>::quiet_NaN()}) {
    Points asked = fan(5);
    asked.row(3).setConstant(bad);
    bool told = false;
    CHECK_THROWS_WITH(measure_many(solver, asked, {[&](double) { told = true; }, {}}),
                      Catch::Matchers::StartsWith("row 3 of the directions: a direction "));
    CHECK_FALSE(told);
  }
  CHECK(measure_many(solver, Points(0, 3)).empty());
}
