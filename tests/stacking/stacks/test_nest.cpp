#include <Eigen/Geometry>

#include "stackabilization/core/errors.h"
#include "stackabilization/stacking/nest.h"
#include "support/catch.h"
#include "support/solids.h"

using namespace stackabilization;

namespace {

/// Open at the top, walls and bottom 1 thick, inside 4 x 4 x 5.
Shape crate() {
  const Shape bottom = solids::box({0, 0, 0}, {6, 6, 1});
  Shape walls = solids::box({0, 0, 0}, {1, 6, 6});
  walls = concatenate(walls, solids::box({5, 0, 0}, {6, 6, 6}));
  walls = concatenate(walls, solids::box({0, 0, 0}, {6, 1, 6}));
  return concatenate(concatenate(bottom, walls), solids::box({0, 5, 0}, {6, 6, 6}));
}

const Direction twice_up(0, 0, 2);

}  // namespace

TEST_CASE("a box that fits sinks to the bottom of a crate") {
  const NestResult nested = nest(crate(), solids::box({1, 1, 10}, {5, 5, 13}), twice_up);
  CHECK(nested.offset == Rational(-4.5));
  CHECK(nested.offset_length == -9);
  CHECK_FALSE(nested.on_floor);
  CHECK(nested.total_height == 6);
  CHECK(nested.saving == 3);
  CHECK(nested.content.vertices.col(2).minCoeff() == 1);
  CHECK(nested.box_volume == Approx(6 * 6 * 6 + 4 * 4 * 3));
  CHECK(nested.stack_box_volume == Approx(6 * 6 * 6));
  CHECK(*nested.stackability() == Approx(48. / 264));
}

TEST_CASE("boxes of a nest are of the model asked for, and sheets have no S") {
  Shape sheet = solids::box({3, 3, 1});
  sheet.vertices.col(2).setZero();
  const NestResult flat = nest(sheet, sheet, twice_up);
  CHECK(flat.box_volume == 0);
  CHECK_FALSE(flat.stackability().has_value());
  Shape turned = solids::box({-1, -1, 0}, {1, 1, 2});
  turned = transformed(turned, Eigen::AngleAxisd(0.5, Eigen::Vector3d::UnitZ()).toRotationMatrix(),
                       Eigen::Vector3d::Zero());
  CHECK(nest(turned, turned, twice_up).box_volume == Approx(16));
  CHECK(nest(turned, turned, twice_up, {.boxes = BoxModel::frame}).box_volume > 16.1);
}

TEST_CASE("a box too wide, or without its play, stays on the rim") {
  for (const double play : {0.0, 0.25}) {
    const double width = play == 0 ? 4.5 : 3.75;  // 0.125 on each side
    const NestResult nested =
        nest(crate(), solids::box({3 - width / 2, 2, 0}, {3 + width / 2, 4, 3}), twice_up, {.play = play});
    CHECK(nested.offset_length == Approx(6));
    CHECK(nested.total_height == Approx(9));
    CHECK(nested.saving == Approx(0).margin(1e-12));
  }
  CHECK(nest(crate(), solids::box({1.125, 2, 0}, {4.875, 4, 3}), twice_up, {.play = 0.12}).offset_length ==
        Approx(1));
}

TEST_CASE("what passes by stands on the same floor") {
  const NestResult nested =
      nest(solids::box({0, 0, 1}, {1, 1, 2}), solids::box({3, 0, 7}, {4, 1, 12}), twice_up);
  CHECK_FALSE(nested.separation.blocked);
  CHECK(nested.on_floor);
  CHECK(nested.offset_length == -6);
  CHECK(nested.total_height == 5);
  CHECK(nested.saving == 1);
}

TEST_CASE("a hood longer than what it covers stands on the floor") {
  Shape hood = crate();
  hood.vertices.col(2) = -hood.vertices.col(2);
  const NestResult nested = nest(solids::box({1, 1, 0}, {5, 5, 2}), hood, twice_up);
  CHECK(nested.separation.blocked);
  CHECK(nested.separation.length == 3);
  CHECK(nested.on_floor);
  CHECK(nested.offset_length == 6);
  CHECK(nested.total_height == 6);
}

TEST_CASE("clearance lifts the content") {
  CHECK(nest(crate(), solids::box({1, 1, 0}, {5, 5, 3}), twice_up, {.clearance = 0.25}).offset_length ==
        1.25);
  CHECK_THROWS_AS(nest(crate(), crate(), twice_up, {.clearance = -1}), UsageError);
  CHECK_THROWS_AS(nest(crate(), crate(), twice_up, {.play = -1}), UsageError);
  CHECK_THROWS_AS(nest(crate(), Shape{}, twice_up), InputError);
}
