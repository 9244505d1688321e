#include <cmath>
#include <limits>
#include <string>

#include "stackabilization/core/errors.h"
#include "stackabilization/stacking/stack_step.h"
#include "support/catch.h"
#include "support/directions.h"
#include "support/solids.h"
#include "support/variants.h"

using namespace stackabilization;
using namespace stackabilization::solids;

namespace {

StepOptions steps_of(int copies, double max_shift) {
  StepOptions options;
  options.stack.copies = copies;
  options.max_shift = max_shift;
  options.accuracy = 0.01;
  options.max_cells = 2000;
  return options;
}

/// A plate of 4 x 4 x 1 with a peg on top, 1 high, at one end of a groove that goes through below, 1 high
/// too.
Shape peg_beside_groove() {
  Shape shape = box({0, 0, 0}, {1, 4, 2});
  shape = concatenate(named(shape, "foot_1"), named(box({2, 0, 0}, {4, 4, 2}), "foot_2"));
  shape = concatenate(shape, named(box({0, 0, 2}, {4, 4, 3}), "plate"));
  return concatenate(shape, named(box({0.1, 1, 3}, {0.9, 3, 4}), "peg"));
}

}  // namespace

TEST_CASE("copies step aside where a peg finds the groove of the next one") {
  // Straight, the foot stands on the peg, 4 apart; one aside, the peg is in the groove, 3 apart, or beside
  // the feet.
  const Shape shape = peg_beside_groove();
  const StepResult found = best_step_stack(shape, upwards, steps_of(4, 1.2));
  CHECK_FALSE(found.straight);
  CHECK(found.second.proven);
  CHECK(found.second.drop.height == 3);
  CHECK(found.stack.height == 4 + 3 * 3);
  CHECK(found.straight_height == 4 + 3 * 4);
  CHECK(std::abs(found.shift.x) >= 0.9);
  CHECK(std::abs(found.shift.x) <= 1.2 + 1e-12);
  for (std::size_t k = 0; k < 4; ++k) {
    const Eigen::Vector3d& moved = found.stack.copies[k].transform.translation;
    CHECK(moved.x() == Approx(static_cast<double>(k) * found.shift.x).margin(1e-12));
    CHECK(found.stack.copies[k].offset_length == 3 * static_cast<double>(k));
  }
  // Half a step is not enough for it.
  const StepResult near = best_step_stack(shape, upwards, steps_of(4, 0.5));
  CHECK(near.straight);
  CHECK(near.shift.x == 0);
  CHECK(near.stack.height == 16);
}

TEST_CASE("a turned pose of the direction gives the same steps") {
  const Eigen::Matrix3d turn = random_rotation(4);
  const Shape turned = transformed(peg_beside_groove(), turn, {3, 2, 1});
  const StepResult found = best_step_stack(turned, Direction(2 * turn.col(2)), steps_of(3, 1.5));
  CHECK(found.stack.height == Approx(4 + 2 * 3));
}

TEST_CASE("a turn between copies makes a screw") {
  // Feet below a plate, and pegs above them: straight, feet stand on pegs; turned, beside them on the plate.
  Shape shape = named(box({-4, -4, 1}, {4, 4, 2}), "plate");
  for (const double x : {-3.0, 3.0})
    for (const double z : {0.0, 2.0})
      shape = concatenate(shape, named(box({x - 0.5, -0.5, z}, {x + 0.5, 0.5, z + 1}),
                                       (z > 0 ? "peg_" : "foot_") + std::to_string(x)));
  StepOptions options = steps_of(4, 0);
  options.stack.clearance = 0.25;
  CHECK(best_step_stack(shape, upwards, options).stack.height == 3 + 3 * 3.25);
  options.turn = true;
  const StepResult found = best_step_stack(shape, upwards, options);
  CHECK_FALSE(found.straight);
  CHECK(found.second.drop.height == Approx(2));
  CHECK(found.stack.height == Approx(3 + 3 * 2.25));
  CHECK(std::abs(found.shift.yaw_degrees) > 10);
}

TEST_CASE("a step between copies refuses what it cannot take") {
  const Shape shape = box({1, 1, 1});
  for (const double shift : {-1.0, std::nan(""), std::numeric_limits<double>::infinity()})
    CHECK_THROWS_AS(best_step_stack(shape, upwards, steps_of(2, shift)), UsageError);
  CHECK_THROWS_AS(best_step_stack(shape, upwards, steps_of(101, 1)), UsageError);
  StepOptions options = steps_of(2, 1);
  options.stack.twist_degrees = 5;
  CHECK_THROWS_AS(best_step_stack(shape, upwards, options), UsageError);
  options = steps_of(2, 1);
  options.stack.poses.resize(1);
  CHECK_THROWS_AS(best_step_stack(shape, upwards, options), UsageError);
  options = steps_of(2, 1);
  options.stack.layer = 0.1;
  CHECK_THROWS_AS(best_step_stack(shape, upwards, options), UsageError);
}
