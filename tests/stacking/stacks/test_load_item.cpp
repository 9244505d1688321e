#include <Eigen/Geometry>
#include <cmath>
#include <limits>

#include "stackabilization/core/errors.h"
#include "stackabilization/stacking/load_item.h"
#include "support/catch.h"
#include "support/meshes.h"
#include "support/solids.h"

using namespace stackabilization;

namespace {

LoadItem item_of(const Shape& shape, double step, const Direction& direction = {0, 0, 1},
                 double clearance = 0) {
  StackabilityOptions options;
  options.clearance = clearance;
  return load_item(StackabilitySolver(shape, options), direction, step);
}

/// The height that a load planner takes for a stack, in whole units.
std::int64_t planned_height(const LoadItem& item, int copies) {
  return item.height + (copies - 1) * (item.height - item.nesting_height);
}

}  // namespace

TEST_CASE("lengths that are whole units stay as they are, in any pose") {
  const Shape box = solids::box({0, 0, 0}, {2, 3, 1.5});
  const Eigen::Matrix3d turn =
      Eigen::AngleAxisd(0.7, Eigen::Vector3d(1, -2, 3).normalized()).toRotationMatrix();
  for (const bool is_turned : {false, true}) {
    const Eigen::Matrix3d pose = is_turned ? turn : Eigen::Matrix3d(Eigen::Matrix3d::Identity());
    const LoadItem item = item_of(transformed(box, pose, {5, 7, -3}), 0.25, Direction(pose.col(2)));
    CHECK(item.length == 12);
    CHECK(item.width == 8);
    CHECK(item.height == 6);
    CHECK(item.increment == 6);
    CHECK(item.nesting_height == 0);
  }
}

TEST_CASE("a planned stack is never below the true one, and each length is as small as it may be") {
  const solids::FrustumShell cup;
  const Shape shape = solids::frustum_shell(cup);
  const StackabilitySolver solver(shape);
  const Stackability measured = solver.measure(Direction(0, 0, 1));
  REQUIRE(measured.f_max == Approx(solids::frustum_shell_f_max(cup)));
  REQUIRE(measured.f_max < 0.6 * measured.extent);
  for (const double step : {1.0, 0.3, 0.07, 0.001}) {
    const LoadItem item = load_item(solver, Direction(0, 0, 1), step);
    for (int copies = 1; copies <= 50; ++copies)
      CHECK(static_cast<double>(planned_height(item, copies)) * step >=
            measured.stack_height(copies) * (1 - 1e-9));
    CHECK((static_cast<double>(item.increment) - 1) * step < measured.f_max);
    CHECK((static_cast<double>(item.height) - 1) * step < measured.extent);
    CHECK(item.nesting_height == item.height - item.increment);
  }
}

TEST_CASE("air between copies is kept, also where it is more than what they save") {
  const Shape box = solids::box({0, 0, 0}, {2, 3, 1.5});
  const LoadItem item = item_of(box, 0.25, {0, 0, 1}, 0.6);
  CHECK(item.increment == 9);  // 2.1
  CHECK(item.height == 9);
  CHECK(item.nesting_height == 0);
}

TEST_CASE("a flat plate has the height of the air on it") {
  StackabilityOptions options;
  options.flat_shapes = FlatShapes::measure;
  options.clearance = 0.1;
  const Shape plate = solids::box({0, 0, 0}, {2, 1, 0});
  const LoadItem item = load_item(StackabilitySolver(plate, options), Direction(0, 0, 1), 0.1);
  CHECK(item.length == 20);
  CHECK(item.width == 10);
  CHECK(item.height == 1);
  CHECK(item.increment == 1);
}

TEST_CASE("a whole unit is a length above 0 that the numbers can count") {
  const Shape box = solids::box({0, 0, 0}, {2, 3, 1.5});
  for (const double step : {0.0, -1.0, std::numeric_limits<double>::quiet_NaN(), 1e-20})
    CHECK_THROWS_AS(item_of(box, step), UsageError);
}
