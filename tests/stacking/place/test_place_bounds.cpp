#include <Eigen/Geometry>
#include <cmath>
#include <limits>
#include <numbers>
#include <vector>

#include "stackabilization/envelope/separation.h"
#include "stackabilization/stacking/rigid_transform.h"
#include "stacking/place/local_frame.h"
#include "stacking/place/place_bounds.h"
#include "support/catch.h"
#include "support/directions.h"
#include "support/point_sets.h"
#include "support/solids.h"
#include "support/variants.h"

using namespace stackabilization;
using detail::LocalPlace;
using detail::LocalShapes;
using detail::PlaceBounds;
using detail::PlaceCell;

namespace {

constexpr double nothing = -std::numeric_limits<double>::infinity();

/// The separation along z with the shape at a place.
Separation separation_at(const LocalShapes& shapes, const LocalPlace& place) {
  const RigidTransform turn = rotation_about({}, place.yaw * 180 / std::numbers::pi);
  const SeparationTree turned(transformed(shapes.shape, turn));
  return separation(SeparationTree(shapes.base), turned.translated({place.x, place.y, 0}), upwards);
}

LocalPlace place_in(const PlaceCell& cell, point_sets::Random& random) {
  const double x = random.uniform(cell.box.x_low, cell.box.x_high),
               y = random.uniform(cell.box.y_low, cell.box.y_high),
               yaw = cell.yaw + random.uniform(-cell.half_turn, cell.half_turn);
  return {x, y, yaw};
}

std::vector<Shape> bases() {
  return {solids::frustum_shell({.segments = 12}), solids::stairs({}), solids::sphere(2, 2),
          solids::extruded_profile({{-3, 0}, {3, 0}, {0, 2}}, 3),
          solids::triangle_soup({.seed = 4, .count = 20, .size = 1})};
}

std::vector<Shape> items() {
  return {solids::box({-1, -1, 0}, {1, 1, 1}), solids::surface_of_revolution({{0, 0}, {1, 1}, {0, 1}}, 8),
          solids::extruded_profile({{-1, 0}, {0, 1}, {1, 0}, {1, 2}, {-1, 2}}, 2),
          solids::triangle_soup({.seed = 5, .count = 12, .size = 1})};
}

}  // namespace

TEST_CASE("no place of a cell has a separation below the bound of the cell") {
  point_sets::Random random(12);
  int shown = 0;
  for (const Shape& base : bases())
    for (const Shape& item : items()) {
      const LocalShapes shapes(base, item, upwards);
      PlaceBounds bounds(shapes);
      for (int k = 0; k < 12; ++k) {
        // Without turns, with turns that move points as the shifts do, and with hardly anything but turns.
        const double width = std::pow(2, -random.uniform(0, 12)) * (k % 3 == 2 ? 1e-3 : 1);
        const double x = random.uniform(-1, 1), y = random.uniform(-1, 1);
        const PlaceCell cell{{x, x + width, y, y + width / 2},
                             k % 3 == 0 ? 0 : random.uniform(-3, 3),
                             k % 3 == 0   ? 0
                             : k % 3 == 1 ? width / 4
                                          : random.uniform(0, 0.3)};
        // More than this no bound of the cell can be.
        const double enough = separation_at(shapes, {x, y, cell.yaw}).length;
        const double low = bounds.search(cell, enough).low;
        shown += low > nothing ? 1 : 0;
        for (int trial = 0; trial < 10; ++trial) {
          const LocalPlace place = place_in(cell, random);
          const Separation found = separation_at(shapes, place);
          REQUIRE((low == nothing || found.blocked));
          if (low == nothing) continue;
          CHECK(found.length >= low - 1e-14 * shapes.size);
          // Where the two touch, less is seen of them, and closer.
          const Eigen::Vector2d at_base = found.witness.upper_point.head<2>();
          const Eigen::Vector2d at_shape =
              Eigen::Rotation2Dd(-place.yaw) * (at_base - Eigen::Vector2d(place.x, place.y));
          CHECK(found.length >= bounds.bound_near(cell, at_shape, at_base).low - 1e-14 * shapes.size);
        }
      }
    }
  CHECK(shown > 80);  // it does not hold because nothing is claimed
}

TEST_CASE("the bound of a cell with one place is the separation there, to rounding and from below") {
  // Level faces differ by two doubles of different size, so that a bound that is rounded up is above it.
  solids::Random random(13);
  for (int k = 0; k < 500; ++k) {
    const double top = random.uniform(0.5, 1), bottom = random.uniform(0.001, 0.01);
    const LocalShapes shapes(solids::box({-1, -1, 0}, {1, 1, top}),
                             solids::box({-0.5, -0.5, bottom}, {0.5, 0.5, 2}), upwards);
    const double x = random.uniform(-1, 1), y = random.uniform(-1, 1);
    const double low = PlaceBounds(shapes).search({{x, x, y, y}, 0, 0}, top - bottom).low;
    REQUIRE(Rational(low) <= Rational(top) - Rational(bottom));
    CHECK(low == Approx(top - bottom).margin(1e-13));
  }
}

TEST_CASE("rectangles that showed a bound of a cell show one of the cells in it") {
  point_sets::Random random(14);
  const LocalShapes shapes(bases()[1], items()[0], upwards);
  PlaceBounds bounds(shapes);
  const PlaceCell cell{{1, 1.25, 0.75, 1}, 0, 0};
  const detail::CellBound whole = bounds.search(cell, separation_at(shapes, {1, 0.75, 0}).length);
  REQUIRE(whole.witness);
  const PlaceCell part{{1.125, 1.25, 0.75, 0.875}, 0, 0};
  const double low = bounds.bound(part, *whole.witness).low;
  CHECK(low >= whole.low - 1e-14 * shapes.size);
  for (int trial = 0; trial < 20; ++trial)
    CHECK(separation_at(shapes, place_in(part, random)).length >= low - 1e-14 * shapes.size);
}
