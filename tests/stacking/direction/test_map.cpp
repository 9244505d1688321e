#include <tbb/global_control.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "stackabilization/core/errors.h"
#include "stackabilization/stacking/map.h"
#include "support/catch.h"
#include "support/solids.h"

using namespace stackabilization;

TEST_CASE("a map goes ring by ring over the hemisphere") {
  const StackabilitySolver solver(solids::frustum_shell({.segments = 8}));
  const StackabilityMap map = stackability_map(solver, {.step_degrees = 30});
  // Pole; rings at 30, 60 and 90 degrees of 8, 12 and 12 directions.
  REQUIRE(map.samples.size() == 33);
  CHECK(map.samples[0].direction == Eigen::Vector3d(0, 0, 1));
  CHECK(map.samples[21].direction == Eigen::Vector3d(1, 0, 0));
  CHECK(map.samples[24].direction == Eigen::Vector3d(0, 1, 0));
  CHECK(map.samples[27].direction == Eigen::Vector3d(-1, 0, 0));
  for (const MapSample& sample : map.samples) {
    CHECK(sample.direction.norm() == Approx(1));
    CHECK(sample.direction.z() == Approx(std::cos(sample.theta * 3.14159265358979 / 180)).margin(1e-12));
    const Stackability measured = solver.measure(Direction(sample.direction));
    CHECK(sample.stackability == measured.value);
    CHECK(sample.f_max_over_height == measured.f_max / measured.extent);
    CHECK(solver.measure(Direction(-sample.direction)).value == Approx(sample.stackability).margin(1e-12));
  }
}

TEST_CASE("a map has the symmetry of its shape") {
  // The cup over an octagon looks the same after a quarter turn about z.
  const StackabilityMap map =
      stackability_map(StackabilitySolver(solids::frustum_shell({.segments = 8})), {.step_degrees = 10});
  for (std::size_t begin = 1, end = 1; begin < map.samples.size(); begin = end) {
    while (end < map.samples.size() && map.samples[end].theta == map.samples[begin].theta) ++end;
    const std::size_t count = end - begin;
    REQUIRE(count % 4 == 0);
    for (std::size_t i = 0; i < count; ++i)
      CHECK(map.samples[begin + (i + count / 4) % count].stackability ==
            Approx(map.samples[begin + i].stackability).margin(1e-9));
  }
}

TEST_CASE("a step of one degree gives 20,969 directions, evenly spread") {
  // Counting needs no shape with many triangles.
  const StackabilityMap map = stackability_map(StackabilitySolver(solids::box({1, 1, 1})), {});
  CHECK(map.samples.size() == 20969);
  Eigen::Vector3d mean = Eigen::Vector3d::Zero();
  for (const MapSample& sample : map.samples)
    mean += sample.direction / static_cast<double>(map.samples.size());
  CHECK((mean - Eigen::Vector3d(0, 0, 0.5)).norm() < 0.01);
}

TEST_CASE("one and two threads map the same bits") {
  const StackabilitySolver solver(solids::frustum_shell({.segments = 8}));
  const auto with_threads = [&](int count) {
    const tbb::global_control control(tbb::global_control::max_allowed_parallelism, count);
    return stackability_map(solver, {.step_degrees = 8});
  };
  const StackabilityMap one = with_threads(1), two = with_threads(2);
  REQUIRE(one.samples.size() == two.samples.size());
  for (std::size_t i = 0; i < one.samples.size(); ++i)
    CHECK(one.samples[i].stackability == two.samples[i].stackability);
}

TEST_CASE("a map reports progress, can be ended, and refuses steps out of range") {
  const StackabilitySolver solver(solids::frustum_shell({.segments = 8}));
  std::vector<double> fractions;
  int asked = 0;
  MapOptions options{.step_degrees = 4};
  options.progress = [&](double fraction) { fractions.push_back(fraction); };
  options.cancelled = [&] { return ++asked > 1; };
  const StackabilityMap ended = stackability_map(solver, options);
  CHECK(ended.cancelled);
  CHECK(ended.samples.size() == 512);
  CHECK(std::is_sorted(fractions.begin(), fractions.end()));
  for (const double step : {0.0, -1.0, 0.05, 91.0, std::nan("")})
    CHECK_THROWS_AS(stackability_map(solver, {.step_degrees = step}), UsageError);
}
