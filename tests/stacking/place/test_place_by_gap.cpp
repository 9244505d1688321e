#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <random>
#include <utility>
#include <vector>

#include "stackabilization/core/errors.h"
#include "stackabilization/envelope/height_field.h"
#include "stackabilization/stacking/place.h"
#include "stacking/place/place_gap.h"
#include "stacking/place/upright_boxes.h"
#include "support/catch.h"
#include "support/directions.h"
#include "support/solids.h"

using namespace stackabilization;
using solids::UprightBox;

namespace {

PlaceOptions least(PlaceGoal goal, double accuracy) {
  PlaceOptions options;
  options.goal = goal;
  options.accuracy = accuracy;
  return options;
}

/// Mean gap, mean depth of the space below, and the area of the overlap.
struct Fit {
  double gap = 0, depth = 0, overlap = 0;
};

/// In closed form: over each rectangle between the lines of all sides both surfaces are level.
Fit fit_of(const std::vector<UprightBox>& ground, std::vector<UprightBox> item, const Eigen::Vector2d& shift,
           double floor) {
  std::vector<double> xs, ys;
  for (UprightBox& block : item)
    for (Eigen::Vector3d* corner : {&block.low, &block.high}) corner->head<2>() += shift;
  for (const auto* blocks : {&ground, &std::as_const(item)})
    for (const UprightBox& block : *blocks) {
      xs.insert(xs.end(), {block.low.x(), block.high.x()});
      ys.insert(ys.end(), {block.low.y(), block.high.y()});
    }
  std::sort(xs.begin(), xs.end());
  std::sort(ys.begin(), ys.end());
  struct Tile {
    double area, below, underside;
  };
  std::vector<Tile> tiles;
  double lift = -std::numeric_limits<double>::infinity(), bottom = -lift;
  for (const UprightBox& block : item) bottom = std::min(bottom, block.low.z());
  lift = floor - bottom;
  for (std::size_t i = 0; i + 1 < xs.size(); ++i)
    for (std::size_t j = 0; j + 1 < ys.size(); ++j) {
      const double x = (xs[i] + xs[i + 1]) / 2, y = (ys[j] + ys[j + 1]) / 2;
      const auto covers = [&](const UprightBox& b) {
        return b.low.x() < x && x < b.high.x() && b.low.y() < y && y < b.high.y();
      };
      Tile tile{(xs[i + 1] - xs[i]) * (ys[j + 1] - ys[j]), -std::numeric_limits<double>::infinity(),
                std::numeric_limits<double>::infinity()};
      for (const UprightBox& b : ground)
        if (covers(b)) tile.below = std::max(tile.below, b.high.z());
      for (const UprightBox& b : item)
        if (covers(b)) tile.underside = std::min(tile.underside, b.low.z());
      if (!std::isfinite(tile.underside) || tile.area == 0) continue;
      if (std::isfinite(tile.below)) lift = std::max(lift, tile.below - tile.underside);
      tiles.push_back(tile);
    }
  Fit fit;
  double area = 0;
  for (const Tile& tile : tiles) {
    area += tile.area;
    fit.depth += tile.area * (lift + tile.underside - std::max(floor, tile.below));
    if (!std::isfinite(tile.below)) continue;
    fit.overlap += tile.area;
    fit.gap += tile.area * (lift + tile.underside - tile.below);
  }
  fit.depth /= area;
  fit.gap /= fit.overlap;
  return fit;
}

/// A thin post 1 high and a broad block 2 high, on nothing.
const std::vector<UprightBox> post_and_block = {{{0.9, 1.9, 0}, {1.1, 2.1, 1}}, {{3, 0, 0}, {7, 4, 2}}};

/// A cone-shaped pit, 64 corners around the axis: from radius 4 at the height 5 down to 0.5 at 1.
Shape round_pit() {
  return solids::surface_of_revolution({{0, 0}, {5, 0}, {5, 5}, {4, 5}, {0.5, 1}, {0, 1}}, 64);
}

}  // namespace

TEST_CASE("the lowest place is on a thin post, the one with the least space below on a block beside it") {
  const Shape base = solids::shape_of(post_and_block), plate = solids::box({0, 0, 0}, {2, 2, 1});
  PlaceOptions options = least(PlaceGoal::height, 1e-2);
  options.region = {{1.5, 1.8}, {5, 1.8}, {5, 2.2}, {1.5, 2.2}};
  CHECK(best_place(base, plate, upwards, options).drop.height == 1);
  for (const PlaceGoal goal : {PlaceGoal::gap, PlaceGoal::volume}) {
    options.goal = goal;
    const BestPlace best = best_place(base, plate, upwards, options);
    CHECK(best.drop.height == 2);
    // Half of it is over the block where it counts as above it at all; all of it where nothing is below.
    CHECK(best.drop.place.x >= (goal == PlaceGoal::gap ? 3 : 4) - 2e-2);
    CHECK(best.value.high <= 1e-2);
    CHECK(best.value.low >= 0);
    CHECK(best.footprint.low <= 4);
    CHECK(best.footprint.high >= 4);
    CHECK(best.footprint.length() < 0.01);
    CHECK(best.proven);
  }
  // Over an area as small as that of the post, the gap is 0 there too, which comes first along x.
  options.goal = PlaceGoal::gap;
  options.min_overlap = 0;
  options.region = {{1.5, 1.8}, {1.9, 1.8}, {1.9, 2.2}, {1.5, 2.2}};
  CHECK(best_place(base, plate, upwards, options).value.high <= 1e-2);
  options.min_overlap = 0.5;
  CHECK_THROWS_AS(best_place(base, plate, upwards, options), UsageError);
}

TEST_CASE("a level plate all over a ramp has half of its rise below it, wherever it lies") {
  Shape ramp = solids::box({0, 0, 0}, {6, 4, 1});
  for (auto corner : ramp.vertices.rowwise())
    if (corner.z() == 1) corner.z() += corner.x() / 4;
  const Shape plate = solids::box({0, 0, 5}, {4, 2, 6});
  for (const PlaceGoal goal : {PlaceGoal::gap, PlaceGoal::volume}) {
    PlaceOptions options = least(goal, 0.05);
    options.region = {{2, 1}, {4, 1}, {4, 3}, {2, 3}};
    const BestPlace best = best_place(ramp, plate, upwards, options);
    CHECK(best.proven);
    CHECK(best.value.low <= 0.5 + 1e-12);
    CHECK(best.value.high >= 0.5 - 1e-12);
    CHECK(best.value.length() <= 0.05 / 4);
    CHECK(best.bound <= 0.5 + 1e-12);
  }
  // Halfway over the upper edge, the gap is that of the half that lies on the ramp; the space grows.
  PlaceOptions beyond = least(PlaceGoal::gap, 0.05);
  beyond.region = {{2, 2}, {6, 2}, {6, 2.1}};
  const BestPlace best = best_place(ramp, plate, upwards, beyond);
  CHECK(best.proven);
  CHECK(best.value.high == Approx(0.25).margin(0.05));
  CHECK(best.drop.place.x == Approx(6).margin(0.2));
}

TEST_CASE("the space below a cone in a pit is that of the closed form, and least in the middle") {
  const Shape cone = solids::surface_of_revolution({{0, 0}, {1, 0}, {2, 2}, {0, 2}}, 64);
  // All sections are regular 64-gons of the same turn, with the area k r^2 each.
  const double lift = 1 + 0.5 * 4 / 3.5;
  const double underside = 10.0 / 3, pit_below = 4 + 8 / 3.5 * (5.0 / 3 + 1.0 / 48);
  const double depth = (4 * lift + underside - pit_below) / 4;
  const BestPlace best = best_place(round_pit(), cone, upwards, least(PlaceGoal::volume, 0.2));
  CHECK(best.proven);
  CHECK(best.value.low <= depth);
  CHECK(best.value.high >= depth);
  CHECK(best.bound <= depth);
  CHECK(best.value.high - best.bound <= 0.2);
  CHECK(best.drop.place.x == 0);
  CHECK(best.footprint.low == Approx(4 * 32 * std::sin(2 * std::numbers::pi / 64)).epsilon(1e-2));
  // The pit is below the whole cone: the mean gap is the mean depth.
  const BestPlace by_gap = best_place(round_pit(), cone, upwards, least(PlaceGoal::gap, 0.2));
  CHECK(by_gap.value.low <= depth);
  CHECK(by_gap.value.high >= depth);
  CHECK(by_gap.proven);
}

TEST_CASE("boxes in general position: the range holds the closed form, and no place is below the bound") {
  std::mt19937 random(23);
  std::uniform_real_distribution<double> unit(0, 1);
  for (int round = 0; round < 4; ++round) {
    const std::vector<UprightBox> ground = solids::random_boxes(6, 2, random),
                                  item = solids::random_boxes(3, 1, random);
    const Shape base = solids::shape_of(ground), shape = solids::shape_of(item);
    double floor = std::numeric_limits<double>::infinity(), footprint_of_base = 0;
    for (const UprightBox& block : ground) floor = std::min(floor, block.low.z());
    const Place given = given_place(shape, upwards);
    footprint_of_base = best_place(base, base, upwards, least(PlaceGoal::volume, 10)).footprint.high;
    for (const PlaceGoal goal : {PlaceGoal::gap, PlaceGoal::volume}) {
      PlaceOptions options = least(goal, 0.1);
      options.region = {{0.5, 0.5}, {2, 0.5}, {2, 2}, {0.5, 2}};
      options.max_cells = 3000;
      const BestPlace best = best_place(base, shape, upwards, options);
      const auto fit_at = [&](double x, double y) {
        return fit_of(ground, item, {x - given.x, y - given.y}, floor);
      };
      const auto value_of = [&](const Fit& fit) { return goal == PlaceGoal::gap ? fit.gap : fit.depth; };
      const Fit found = fit_at(best.drop.place.x, best.drop.place.y);
      CHECK(value_of(found) >= best.value.low - 1e-9);
      CHECK(value_of(found) <= best.value.high + 1e-9);
      CHECK(best.value.length() <= 0.1 / 4);
      const double needed = 0.5 * std::min(best.footprint.high, footprint_of_base);
      if (goal == PlaceGoal::gap) CHECK(found.overlap >= needed * (1 - 1e-6));
      double least_seen = best.value.high;
      for (int k = 0; k < 2000; ++k) {
        const Fit fit = fit_at(0.5 + 1.5 * unit(random), 0.5 + 1.5 * unit(random));
        if (goal == PlaceGoal::gap && fit.overlap < needed * (1 + 1e-6)) continue;
        REQUIRE(value_of(fit) >= best.bound - 1e-9);
        least_seen = std::min(least_seen, value_of(fit));
      }
      CHECK(best.value.high <= least_seen + options.accuracy);
    }
  }
}

TEST_CASE("the bounds of the space hold for all turns, by dense samples of both surfaces") {
  const Shape bar = solids::box({-1.5, -0.3, 0}, {1.5, 0.3, 1});
  const Shape base = concatenate(round_pit(), solids::box({0.4, -4, 1}, {0.6, 4, 2.5}));
  PlaceOptions options = least(PlaceGoal::volume, 0.2);
  options.turn = true;
  options.max_cells = 500;
  const BestPlace best = best_place(base, bar, upwards, options);
  const auto depth_at = [&](const Place& place) {
    const Drop drop = drop_at(base, bar, upwards, place);
    const Shape moved = transformed(bar, drop.transform);
    const Window window = window_around(moved, upwards, 200);
    const HeightField above = height_field_by_rays(moved, upwards, window),
                      below = height_field_by_rays(base, upwards, window);
    double sum = 0, count = 0;
    for (int j = 0; j < window.rows; ++j)
      for (int i = 0; i < window.columns; ++i) {
        if (!above.covered(i, j)) continue;
        ++count;
        sum += above.lower(i, j) + drop.lift_length - std::max(0.0, below.upper(i, j));
      }
    return sum / count;
  };
  CHECK(depth_at(best.drop.place) >= best.value.low - 0.02);
  CHECK(depth_at(best.drop.place) <= best.value.high + 0.02);
  std::mt19937 random(3);
  std::uniform_real_distribution<double> unit(-1, 1);
  for (int i = 0; i < 60; ++i)
    CHECK(depth_at({2 * unit(random), 2 * unit(random), 180 * unit(random)}) >= best.bound - 0.02);
}

TEST_CASE("cells of places and turns: an L on a ramp, in closed form, tight where the turn is known") {
  Shape ramp = solids::box({-20, -20, 0}, {20, 20, 1});
  for (auto corner : ramp.vertices.rowwise())
    if (corner.z() == 1) corner.z() = 10 + corner.x() / 4;
  const Shape item = concatenate(solids::box({-2, -2, 0}, {2, -1, 1}), solids::box({-2, -1, 0}, {-1, 2, 1}));
  const std::vector<Eigen::Vector2d> corners = {{-2, -2}, {2, -2}, {2, -1}, {-1, 2}, {-2, 2}};
  const Eigen::Vector2d centroid(-4.5 / 7, -4.5 / 7);
  const auto rise_of = [](const Eigen::Vector2d& point, double yaw) {
    return (Eigen::Rotation2Dd(yaw) * point).x() / 4;
  };
  const auto highest = [&](double yaw) {
    double high = -1;
    for (const Eigen::Vector2d& corner : corners) high = std::max(high, rise_of(corner, yaw));
    return high;
  };
  detail::PlaceBounds bounds(detail::LocalShapes(ramp, item, upwards));
  detail::PlaceGap gap(bounds, PlaceGoal::volume, 0, bounds.area_of_shape());
  std::mt19937 random(5);
  std::uniform_real_distribution<double> unit(-1, 1);
  for (int k = 0; k < 30; ++k) {
    const double x = 5 * unit(random), y = 5 * unit(random), yaw = 3 * unit(random);
    const double width = k % 3 == 0 ? 0 : 0.2, half_turn = k % 2 == 0 ? 0 : 0.1;
    const detail::PlaceCell cell{{x - width, x + width, y - width, y + width}, yaw, half_turn};
    double least_rise = 1e9, truth = 1e9;
    for (int step = -20; step <= 20; ++step) {
      const double turned = yaw + step * half_turn / 20;
      least_rise = std::min(least_rise, highest(turned));
      truth = std::min(truth, highest(turned) - rise_of(centroid, turned));
    }
    // Between the steps of the turn it can be a little less.
    const double slack = half_turn * half_turn;
    const double low = gap.low(cell, {10 + x / 4 + least_rise - slack, {0.25, 0}}, truth + 1e-6);
    CHECK(low <= truth + 1e-9);
    if (half_turn == 0) CHECK(low >= truth - (width == 0 ? 0.02 : 0.1));
    // The mean over a rectangle, in the middle of the cell, at both ends of the turn.
    const detail::PlanarBox part{1.2, 1.9, -1.9, -1.2};
    const auto [mean_low, mean_high] = bounds.mean_difference(cell, part);
    for (const double turned : {yaw - half_turn, yaw, yaw + half_turn}) {
      const double mean = 10 + x / 4 + rise_of({1.55, -1.55}, turned);
      CHECK(mean_low.centre <= mean + 1e-12);
      CHECK(mean_high.centre >= mean - 1e-12);
    }
    CHECK(mean_low.slope.isApprox(Eigen::Vector2d(0.25, 0)));
    if (half_turn == 0) CHECK(mean_high.centre - mean_low.centre < 1e-9);
  }
}

TEST_CASE("goals that need an area refuse shapes without one, and shares out of range") {
  const Shape cube = solids::box({1, 1, 1});
  Shape wall = cube;
  wall.vertices.col(0).setZero();
  CHECK_THROWS_AS(best_place(cube, wall, upwards, least(PlaceGoal::volume, 0.2)), InputError);
  PlaceOptions options = least(PlaceGoal::gap, 0.1);
  for (const double share : {-0.1, 1.1, std::nan("")}) {
    options.min_overlap = share;
    CHECK_THROWS_AS(best_place(cube, cube, upwards, options), UsageError);
  }
}
