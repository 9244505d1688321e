#include <Eigen/Geometry>
#include <cmath>

#include "stackabilization/stacking/bundle_ascent.h"
#include "stackabilization/stacking/tolerances.h"
#include "support/catch.h"
#include "support/solids.h"
#include "support/variants.h"

using namespace stackabilization;

namespace {

const DirectionRegion everywhere(std::nullopt, std::nullopt);

LocalOptimum climb_from(const StackabilitySolver& solver, const DirectionRegion& region,
                        const Eigen::Vector3d& start) {
  return bundle_ascent(solver, region, solver.measure(Direction(start)), {0.02, tolerance::direction_step});
}

}  // namespace

TEST_CASE("a climb near the axis of a cup ends at the axis") {
  const StackabilitySolver solver(solids::frustum_shell({.segments = 8}));
  const double best = solver.measure(Direction(0, 0, 1)).value;
  for (const Eigen::Vector3d& start : {Eigen::Vector3d(0.01, 0.02, 1), Eigen::Vector3d(-0.03, 0.01, 1)}) {
    const LocalOptimum end = climb_from(solver, everywhere, start);
    CHECK(end.at.value == Approx(best).margin(1e-6));
    CHECK(end.at.direction.head<2>().norm() < 1e-6);
    CHECK(end.evaluated > 3);
  }
}

TEST_CASE("a climb never ends below its start, and knows what it measured") {
  const StackabilitySolver solver(solids::triangle_soup({.seed = 8, .count = 30}));
  for (std::uint64_t seed = 1; seed <= 10; ++seed) {
    const Eigen::Vector3d start = solids::Random(seed).on_sphere();
    const LocalOptimum end = climb_from(solver, everywhere, start);
    CHECK(end.at.value >= solver.measure(Direction(start)).value);
    CHECK(end.at.value == solver.measure(Direction(end.at.direction)).value);
  }
}

TEST_CASE("a climb stays in its region") {
  const StackabilitySolver solver(solids::frustum_shell({.segments = 8}));
  const Eigen::Vector3d axis(std::sin(0.06), 0, std::cos(0.06));
  const DirectionRegion cone(DirectionCone{axis, 0.04}, std::nullopt);
  const LocalOptimum end = climb_from(solver, cone, axis);
  CHECK(std::atan2(end.at.direction.cross(axis).norm(), end.at.direction.dot(axis)) ==
        Approx(0.04).epsilon(1e-6));
}

TEST_CASE("a climb that is cancelled stays where it is") {
  const StackabilitySolver solver(solids::frustum_shell({.segments = 8}));
  const Stackability start = solver.measure(Direction(0.01, 0.02, 1));
  int steps = 0;
  AscentOptions options{0.02, tolerance::direction_step, [&] { return steps++ == 2; }};
  const LocalOptimum end = bundle_ascent(solver, everywhere, start, options);
  CHECK(steps == 3);
  CHECK(end.at.value >= start.value);
  options.cancelled = [] { return true; };
  CHECK(bundle_ascent(solver, everywhere, start, options).at.direction == start.direction);
}
