#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <random>

#include "stackabilization/core/errors.h"
#include "stackabilization/stacking/place.h"
#include "stacking/place/upright_boxes.h"
#include "support/catch.h"
#include "support/solids.h"

using namespace stackabilization;
using solids::UprightBox;

namespace {

const Direction up(0, 0, 1);

/// Walls and bottom 1 thick, inside [1, 5] x [1, 3] x [1, 6].
Shape tray() {
  const Shape bottom = solids::box({0, 0, 0}, {6, 4, 1});
  Shape walls = concatenate(solids::box({0, 0, 0}, {1, 4, 6}), solids::box({5, 0, 0}, {6, 4, 6}));
  walls = concatenate(walls, solids::box({0, 0, 0}, {6, 1, 6}));
  return concatenate(concatenate(bottom, walls), solids::box({0, 3, 0}, {6, 4, 6}));
}

/// A cone-shaped pit, 64 corners around (x, y): from radius 4 at the height 5 down to 0.5 at 1.
Shape pit(double x, double y) {
  Shape shape = solids::surface_of_revolution({{0, 0}, {5, 0}, {5, 5}, {4, 5}, {0.5, 1}, {0, 1}}, 64);
  shape.vertices.col(0).array() += x;
  shape.vertices.col(1).array() += y;
  return shape;
}

PlaceOptions within(double accuracy) {
  PlaceOptions options;
  options.accuracy = accuracy;
  return options;
}

/// The smallest height at the places of a grid over a box of centres.
double lowest_of_grid(const Shape& base, const Shape& shape, const Eigen::Vector2d& low,
                      const Eigen::Vector2d& high, int steps) {
  double lowest = std::numeric_limits<double>::infinity();
  for (int i = 0; i <= steps; ++i)
    for (int j = 0; j <= steps; ++j) {
      const Eigen::Vector2d p = low + Eigen::Vector2d(i, j).cwiseProduct(high - low) / steps;
      lowest = std::min(lowest, drop_at(base, shape, up, {p.x(), p.y(), 0}).height);
    }
  return lowest;
}

}  // namespace

TEST_CASE("a box comes to rest at the bottom of a tray, wherever it started") {
  for (const double start : {-7.0, 0.0, 2.5}) {
    const Shape box = solids::box({start, start, 9}, {start + 2, start + 1.5, 10});
    const BestPlace best = best_place(tray(), box, up, within(1e-3));
    CHECK(best.drop.height == 1);
    CHECK(best.proven);
    CHECK(best.bound >= 1 - 1e-3);
    CHECK(best.open == 0);
    CHECK(best.drop.lift_length == -8);
    CHECK_FALSE(best.drop.on_floor);
  }
}

TEST_CASE("a box too wide for a tray stays on its rim, whatever the place, and goes in when it may turn") {
  const Shape box = solids::box({0, 0, 0}, {1.5, 3.5, 1});
  const BestPlace straight = best_place(tray(), box, up, within(1e-2));
  CHECK(straight.drop.height == 6);
  CHECK(straight.bound == Approx(6).margin(1e-2));
  CHECK(straight.proven);
  PlaceOptions turning = within(1e-2);
  turning.turn = true;
  const BestPlace turned = best_place(tray(), box, up, turning);
  CHECK(turned.drop.height == Approx(1));
  CHECK(turned.proven);
  // 3.9 long, so that the free turn away from a quarter turn is small.
  const BestPlace tight = best_place(tray(), solids::box({0, 0, 0}, {1.5, 3.9, 1}), up, turning);
  CHECK(tight.drop.height == Approx(1));
  CHECK(std::abs(std::abs(tight.drop.place.yaw_degrees) - 90) < 10);
}

TEST_CASE("a box slips through a slit that it fits by a hundredth, and only there") {
  // Two plates on a ground leave a slit from 2 to 3.001 between them.
  Shape base = solids::box({1, 0, 0}, {4, 1.5, 1});
  base = concatenate(base, solids::box({1, 0, 1}, {2, 1.5, 5}));
  base = concatenate(base, solids::box({3.01, 0, 1}, {4, 1.5, 5}));
  const BestPlace in = best_place(base, solids::box({0, 0, 0}, {1, 1, 1}), up, within(0.05));
  CHECK(in.drop.height == 1);
  CHECK(in.drop.place.x > 2.5 - 1e-9);
  CHECK(in.drop.place.x < 2.51 + 1e-9);
  CHECK(in.proven);
  const BestPlace on = best_place(base, solids::box({0, 0, 0}, {1.02, 1, 1}), up, within(0.05));
  CHECK(on.drop.height == 5);
  CHECK(on.proven);
}

TEST_CASE("a cone finds the middle of a pit, to its depth in closed form") {
  // The cone of slope 2 stands on the edge of its foot, radius 1, where the pit has slope 4 / 3.5:
  // 1 + (1 - 0.5) * 4 / 3.5.
  const Shape cone = solids::surface_of_revolution({{0, 0}, {1, 0}, {2, 2}, {0, 2}}, 64);
  for (const double x : {0.0, 1.25}) {
    const BestPlace best = best_place(pit(x, -x), cone, up, within(1e-2));
    CHECK(best.drop.height == Approx(1 + 0.5 * 4 / 3.5).margin(1e-6));
    CHECK(best.drop.height >= 1 + 0.5 * 4 / 3.5 - 1e-12);
    CHECK(best.drop.place.x == Approx(x).margin(1e-2));
    CHECK(best.drop.place.y == Approx(-x).margin(1e-2));
    CHECK(best.proven);
    CHECK(best.bound <= best.drop.height);
    CHECK(best.bound >= best.drop.height - 1e-2);
  }
}

TEST_CASE("a plate on a ramp goes downhill, proven by what lies inside of the upper edge") {
  Shape ramp = solids::box({0, 0, 0}, {4, 4, 1});
  for (auto corner : ramp.vertices.rowwise())
    if (corner.z() == 1) corner.z() += corner.x() / 4;
  PlaceOptions options = within(1e-3);
  options.region = {{1.5, 1.5}, {2.5, 1.5}, {2.5, 2.5}, {1.5, 2.5}};
  const BestPlace best = best_place(ramp, solids::box({0, 0, 5}, {4, 4, 6}), up, options);
  // Its right side is at 3.5 at best.
  CHECK(best.drop.height == Approx(1 + 3.5 / 4));
  CHECK(best.drop.place.x == 1.5);
  CHECK(best.proven);
  CHECK(best.cells < 1000);
}

TEST_CASE("a ball in a bowl rests at its bottom: no place of a grid is below the bound") {
  const Shape ball = solids::sphere(1, 1), bowl = pit(0.3, 0.2);
  const BestPlace best = best_place(bowl, ball, up, within(0.02));
  CHECK(best.proven);
  const double lowest = lowest_of_grid(bowl, ball, {-1, -1}, {1.5, 1.5}, 10);
  CHECK(lowest >= best.bound);
  CHECK(best.drop.height <= lowest);
}

TEST_CASE("boxes in general position: the lowest place is that of the Minkowski sum") {
  // For upright boxes, a shape of boxes can come down at a place to the largest sum of heights over the boxes
  // whose rectangles meet: constant between the lines where two sides meet. So the cells between these lines
  // give all heights.
  std::mt19937 random(11);
  for (int round = 0; round < 6; ++round) {
    std::vector<UprightBox> ground = solids::random_boxes(6, 3, random);
    ground.push_back({{-1, -1, -1}, {5, 5, 0}});
    const std::vector<UprightBox> item = solids::random_boxes(3, 1, random);
    const Shape base = solids::shape_of(ground), shape = solids::shape_of(item);
    const Place given = given_place(shape, up);
    std::vector<double> xs, ys;
    for (const UprightBox& a : ground)
      for (const UprightBox& b : item) {
        xs.insert(xs.end(), {a.low.x() - b.high.x(), a.high.x() - b.low.x()});
        ys.insert(ys.end(), {a.low.y() - b.high.y(), a.high.y() - b.low.y()});
      }
    std::sort(xs.begin(), xs.end());
    std::sort(ys.begin(), ys.end());
    PlaceOptions options = within(1e-3);
    options.region = {{0.5, 0.5}, {3, 0.5}, {3, 3}, {0.5, 3}};
    double lowest = std::numeric_limits<double>::infinity(), bottom = lowest;
    for (const UprightBox& b : item) bottom = std::min(bottom, b.low.z());
    for (std::size_t i = 0; i + 1 < xs.size(); ++i)
      for (std::size_t j = 0; j + 1 < ys.size(); ++j) {
        // A piece of the cell must lie in the region.
        const double x_low = std::max(xs[i], 0.5 - given.x), x_high = std::min(xs[i + 1], 3 - given.x);
        const double y_low = std::max(ys[j], 0.5 - given.y), y_high = std::min(ys[j + 1], 3 - given.y);
        if (x_low >= x_high || y_low >= y_high) continue;
        const double x = (x_low + x_high) / 2, y = (y_low + y_high) / 2;
        double lift = -1 - bottom;
        for (const UprightBox& a : ground)
          for (const UprightBox& b : item)
            if (a.low.x() < b.high.x() + x && b.low.x() + x < a.high.x() && a.low.y() < b.high.y() + y &&
                b.low.y() + y < a.high.y())
              lift = std::max(lift, a.high.z() - b.low.z());
        lowest = std::min(lowest, lift + bottom + 1);
      }
    const BestPlace best = best_place(base, shape, up, options);
    CHECK(best.proven);
    CHECK(best.drop.height == Approx(lowest).margin(1e-9));
    CHECK(best.bound <= lowest + 1e-12);
  }
}

TEST_CASE("the bound holds for all turns, and fewer cells prove less") {
  Shape base = pit(0, 0);
  const Shape bar = solids::box({-1.5, -0.3, 0}, {1.5, 0.3, 1});
  base = concatenate(base, solids::box({0.4, -4, 1}, {0.6, 4, 2.5}));
  PlaceOptions options = within(0.1);
  options.turn = true;
  options.max_cells = 600;
  const BestPlace best = best_place(base, bar, up, options);
  double lowest = std::numeric_limits<double>::infinity();
  std::mt19937 random(3);
  std::uniform_real_distribution<double> unit(-1, 1);
  for (int i = 0; i < 100; ++i)
    lowest = std::min(
        lowest, drop_at(base, bar, up, {2 * unit(random), 2 * unit(random), 180 * unit(random)}).height);
  CHECK(lowest >= best.bound - 1e-12);
  options.max_cells = 30;
  const BestPlace hasty = best_place(base, bar, up, options);
  CHECK_FALSE(hasty.proven);
  CHECK(hasty.open > 0);
  CHECK(hasty.bound <= best.bound + 1e-12);
  CHECK(hasty.bound <= lowest);
}

TEST_CASE("a place does not depend on the axis along which things come down") {
  const Shape cone = solids::surface_of_revolution({{0, 0}, {1, 0}, {2, 2}, {0, 2}}, 16);
  const BestPlace upright = best_place(pit(1, 2), cone, up, within(1e-2));
  const RigidTransform tilt = rotation_about({{0, 0, 0}, Direction(1, 2, 0)}, 50);
  const Direction along(2 * tilt.rotation * Eigen::Vector3d::UnitZ());
  const BestPlace tilted =
      best_place(transformed(pit(1, 2), tilt), transformed(cone, tilt), along, within(1e-2));
  CHECK(tilted.proven);
  CHECK(tilted.drop.height == Approx(upright.drop.height).margin(1e-2));
}

TEST_CASE("places far apart, upside down and beside are clear answers") {
  const Shape cube = solids::box({0, 0, 0}, {1, 1, 1});
  const Drop beside = drop_at(cube, cube, up, {7, 0.5, 0});
  CHECK(beside.on_floor);
  CHECK(beside.height == 0);
  CHECK_FALSE(beside.separation.blocked);
  CHECK(drop_at(cube, cube, Direction(0, 0, -2), given_place(cube, Direction(0, 0, -2))).height == 1);
  PlaceOptions options = within(1e-3);
  options.region = {{9, 9}, {10, 9}, {9.5, 10}};
  const BestPlace away = best_place(cube, cube, up, options);
  CHECK(away.drop.height == 0);
  CHECK(away.drop.on_floor);
  CHECK(away.proven);
}

TEST_CASE("a map has the heights of the places, and its minimum is no lower than the bound") {
  const Shape cone = solids::surface_of_revolution({{0, 0}, {1, 0}, {2, 2}, {0, 2}}, 16);
  const Shape base = pit(0, 0);
  const DropMap map = drop_map(base, cone, up, 0.75, 0, {});
  CHECK(map.x.size() == 9);  // 10 - 4 wide
  CHECK(map.x[4] == 0);
  double lowest = std::numeric_limits<double>::infinity();
  for (std::size_t j = 0; j < map.y.size(); ++j)
    for (std::size_t i = 0; i < map.x.size(); ++i) {
      const double height = map.heights[j * map.x.size() + i];
      CHECK(height == Approx(drop_at(base, cone, up, {map.x[i], map.y[j], 0}).height).margin(1e-12));
      lowest = std::min(lowest, height);
    }
  CHECK(best_place(base, cone, up, within(1e-2)).bound <= lowest);
}

TEST_CASE("options out of range and shapes without triangles are refused") {
  const Shape cube = solids::box({1, 1, 1});
  CHECK_THROWS_AS(best_place(cube, cube, up, within(0)), UsageError);
  CHECK_THROWS_AS(best_place(cube, {}, up, within(1)), InputError);
  PlaceOptions line = within(1);
  line.region = {{0, 0}, {1, 1}};
  CHECK_THROWS_AS(best_place(cube, cube, up, line), UsageError);
  line.region = {{0, 0}, {1, 1}, {NAN, 1}};
  CHECK_THROWS_AS(best_place(cube, cube, up, line), UsageError);
  CHECK_THROWS_AS(drop_at(cube, cube, up, {NAN, 0, 0}), UsageError);
  CHECK_THROWS_AS(drop_map(cube, cube, up, 0, 0, {}), UsageError);
  line.region = {{0, 0}, {1, 0}, {1, 1}};
  CHECK_THROWS_AS(drop_map(cube, cube, up, 1e-6, 0, line), UsageError);
}
