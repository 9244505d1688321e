#include <Eigen/Geometry>
#include <cmath>
#include <limits>
#include <numbers>

#include "stackabilization/core/errors.h"
#include "stackabilization/stacking/seating.h"
#include "support/catch.h"
#include "support/directions.h"
#include "support/solids.h"
#include "support/variants.h"

namespace stackabilization {
namespace {

constexpr double pi = std::numbers::pi;

SeatingOptions with_friction(double friction) {
  SeatingOptions options;
  options.friction = friction;
  return options;
}

/// A cup with walls that lie against each other in a stack: they widen by 1 over a height of 8.
Shape tapered_cup(int segments) {
  return solids::frustum_shell(
      {.outer_bottom = 3, .outer_top = 4, .inner_bottom = 2.5625, .inner_top = 3.5, .segments = segments});
}

/// A round box of the radius 1.5 with a foot that stands in the one below, with `gap` around it.
Shape footed_box(double gap, int segments = 24) {
  return solids::surface_of_revolution(
      {{0, 0}, {1 - gap, 0}, {1 - gap, 1}, {1.5, 1}, {1.5, 3}, {1, 3}, {1, 2}, {0, 2}}, segments);
}

TEST_CASE("a tapered cup centres itself by the slope of its wall, and jams by its draft") {
  for (const int segments : {8, 24, 64}) {
    const double draft = std::atan(std::cos(pi / segments) / 8);  // of a side of the polygon
    for (const double friction : {0.0, 0.1, 0.2, 0.5}) {
      INFO(segments << " segments, friction " << friction);
      const Seating seat = seating(tapered_cup(segments), upwards, with_friction(friction));
      CHECK(seat.centring_slope == Approx(8));
      CHECK(seat.draft_degrees == Approx(draft * 180 / pi));
      const double along = friction * std::cos(draft), against = std::sin(draft);
      CHECK(seat.pull_off == Approx(std::max(0.0, (along - against) / (along + against))).margin(1e-9));
      CHECK((seat.upper_part == 0) == (seat.pull_off > 0));
    }
  }
}

TEST_CASE("how a copy sits does not depend on its pose, its size or its orientation") {
  const Shape cup = tapered_cup(12);
  const Seating expected = seating(cup, upwards);
  const Eigen::Matrix3d turn =
      Eigen::AngleAxisd(0.8, Eigen::Vector3d(1, -2, 0.5).normalized()).toRotationMatrix();
  for (const double scale : {1e-4, 1.0, 1e5}) {
    Shape moved = cup;
    moved.vertices =
        (scale * cup.vertices * turn.transpose()).rowwise() + Eigen::RowVector3d(3, -1, 2) * scale;
    for (const Shape& shape : {moved, solids::flipped(moved)}) {
      const Seating seat = seating(shape, Direction(2 * turn.col(2)));
      INFO(scale);
      CHECK(seat.centring_slope == Approx(expected.centring_slope).epsilon(1e-6));
      CHECK(seat.draft_degrees == Approx(expected.draft_degrees).epsilon(1e-6));
      CHECK(seat.pull_off == Approx(expected.pull_off).epsilon(1e-6));
    }
  }
}

TEST_CASE("boxes stay where they are put") {
  const Seating seat = seating(solids::box(Eigen::Vector3d(2, 3, 1)), upwards);
  CHECK(seat.centring_slope == 0);
  CHECK(seat.draft_degrees == 90);
  CHECK(seat.pull_off == 0);
  CHECK(seat.upper_part == -1);
  CHECK(seat.tight.empty());
  CHECK_FALSE(seat.jams());
}

TEST_CASE("copies on slopes slide off their place") {
  // The bottom and the top of a block, both with the slope 0.25.
  const Shape block = solids::extruded_profile({{0, 0}, {4, 1}, {4, 2}, {0, 1}}, 3);
  CHECK(seating(block, upwards).centring_slope == Approx(-0.25));
}

TEST_CASE("upright walls around a foot jam when they are tight") {
  const int segments = 24;
  for (const double gap : {0.001, 0.004, 0.02}) {
    SeatingOptions options = with_friction(0.2);
    options.side_gap = 0.01;
    const Seating seat = seating(footed_box(gap, segments), upwards, options);
    INFO(gap);
    CHECK(seat.pull_off == 0);  // it rests on level ground
    CHECK(seat.centring_slope == 0);
    CHECK(seat.jams() == (gap < 0.01));
    REQUIRE(seat.tight.size() == (gap < 0.01 ? 1 : 0));
    if (seat.tight.empty()) continue;
    CHECK(seat.tight[0].draft_degrees == Approx(0).margin(1e-9));
    CHECK(seat.tight[0].gap == Approx(gap * std::cos(pi / segments)).epsilon(1e-6));
    CHECK(seat.walls_pull_off == Approx(1));  // upright
    const double wall = 2 * segments * (1 - gap) * std::sin(pi / segments);
    CHECK(seat.tight[0].area == Approx(wall).epsilon(0.02));
    CHECK_FALSE(seating(footed_box(gap, segments), upwards, with_friction(0)).jams());
  }
}

TEST_CASE("tight walls with draft hold with the friction along them less their slope") {
  const int segments = 24;
  const double gap = 0.001, friction = 0.2, tangent = 0.05 * std::cos(pi / segments);
  const Shape box = solids::surface_of_revolution(
      {{0, 0}, {0.95 - gap, 0}, {1 - gap, 1}, {1.5, 1}, {1.5, 3}, {1, 3}, {0.95, 2}, {0, 2}}, segments);
  const Seating seat = seating(box, upwards, with_friction(friction));
  CHECK(seat.pull_off == 0);
  CHECK(seat.walls_pull_off == Approx((friction - tangent) / (friction + tangent)));
}

TEST_CASE("a tight wall on one side does not jam") {
  const double gap = 0.001;
  const Shape step = solids::extruded_profile(
      {{0, 0}, {3 - gap, 0}, {3 - gap, 0.8}, {4, 0.8}, {4, 1.8}, {3, 1.8}, {3, 1}, {0, 1}}, 2);
  const Seating seat = seating(step, upwards);
  REQUIRE(seat.tight.size() == 1);
  CHECK(seat.tight[0].gap == Approx(gap).epsilon(1e-6));
  CHECK_FALSE(seat.jams());
}

TEST_CASE("sheets that lie in each other resist a pull at most as much as the push") {
  const Shape bowl = solids::bumpy_bowl(24);
  for (const Direction& direction : {Direction(0, 0, 1), Direction(0.3, -0.2, 1)}) {
    const Seating seat = seating(bowl, direction, with_friction(0.5));
    CHECK(seat.pull_off >= 0);
    CHECK(seat.pull_off <= 1);
    CHECK(seat.walls_pull_off <= 1);
    for (const TightWalls& wall : seat.tight) CHECK(wall.gap <= 1e-9);
  }
}

TEST_CASE("seating refuses what has none") {
  const Shape cube = solids::box(Eigen::Vector3d(1, 1, 1));
  for (const double bad : {-0.1, std::numeric_limits<double>::infinity(), std::nan("")})
    CHECK_THROWS_AS(seating(cube, upwards, with_friction(bad)), UsageError);
  SeatingOptions options;
  options.band = 0;
  CHECK_THROWS_AS(seating(cube, upwards, options), UsageError);
  options = {};
  options.side_gap = -0.1;
  CHECK_THROWS_AS(seating(cube, upwards, options), UsageError);
  options = {};
  options.samples = 0;
  CHECK_THROWS_AS(seating(cube, upwards, options), UsageError);
  options = {};
  options.up = Eigen::Vector3d(0, 0, -1);
  CHECK_THROWS_AS(seating(cube, upwards, options), UsageError);
  CHECK_THROWS_AS(seating(Shape{}, upwards), InputError);
}

}  // namespace
}  // namespace stackabilization
