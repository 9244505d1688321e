// Heights at places against Minkowski sums, which share no code with them.
#include <algorithm>
#include <limits>
#include <optional>
#include <random>
#include <vector>

#include "stackabilization/stacking/minkowski.h"
#include "stackabilization/stacking/place.h"
#include "support/catch.h"
#include "support/directions.h"
#include "support/solids.h"
#include "support/variants.h"

using namespace stackabilization;

namespace {

/// How far the item is put below the base: more than all lifts of either alone, and no rounding of heights
/// that are multiples of a small power of two.
constexpr double far_below = 64;

/// sep(base, item, z): f_max of the two as one solid, when the item starts far below the base. Nothing when
/// they pass each other.
std::optional<Rational> minkowski_separation(const Shape& base, Shape item) {
  item.vertices.col(2).array() -= far_below;
  const Rational sum = minkowski_translation(concatenate(base, item), upwards);
  if (sum < Rational(far_below / 2)) return std::nullopt;
  return sum - Rational(far_below);
}

/// The height of the item above the floor of the base at a place. Both stand at z = 0.
Rational minkowski_height(const Shape& base, const Shape& item, const Place& place) {
  const Shape moved = transformed(item, transform_to(item, upwards, place));
  const Rational floor(0.0);
  return std::max(minkowski_separation(base, moved).value_or(floor), floor);
}

struct Pair {
  Shape base, item;
};

/// Corners are multiples of an eighth in height.
std::vector<Pair> pairs() {
  const Shape stairs = solids::stairs({.count = 2, .tread = 1, .rise = 0.75, .width = 2});
  const Shape valley = solids::extruded_profile({{0, 0}, {4, 0}, {4, 2}, {2, 0.5}, {0, 2}}, 2);
  const Shape tetrahedron =
      solids::tetrahedron({{{0, 0, 1}, {1, 0.25, 1.5}, {0.25, 1, 1.25}, {0.5, 0.5, 0}}});
  const Shape roof = solids::extruded_profile({{0, 0}, {1, 0}, {0.5, 0.75}}, 0.75);
  return {{stairs, tetrahedron}, {valley, tetrahedron}, {valley, roof}, {stairs, roof}};
}

}  // namespace

TEST_CASE("the height at a place is that of the Minkowski sum, as one rational number", "[minkowski]") {
  std::mt19937 random(5);
  std::uniform_real_distribution<double> across(-0.5, 2.5), turn(-180, 180);
  int on_floor = 0, above = 0;
  for (const auto& [base, item] : pairs())
    for (int k = 0; k < 8; ++k) {
      const double x = across(random), y = across(random), yaw = turn(random);
      const Place place{x, y, k % 2 == 0 ? 0 : yaw};
      const Drop drop = drop_at(base, item, upwards, place);
      CAPTURE(place.x, place.y, place.yaw_degrees, drop.height);
      const Rational height = minkowski_height(base, item, place);
      if (place.yaw_degrees == 0)
        CHECK(height == drop.lift);
      else  // a turn rounds heights, and lowering the item does so once more
        CHECK(height.to_double() == Approx(drop.lift.to_double()).margin(1e-13));
      ++(drop.on_floor ? on_floor : above);
    }
  CHECK(on_floor > 0);
  CHECK(above > 10);
}

TEST_CASE("the best place has the height of the Minkowski sum, and no other one is below its bound",
          "[minkowski]") {
  std::mt19937 random(6);
  std::uniform_real_distribution<double> unit(0, 1);
  int proven = 0;
  for (const auto& [base, item] : pairs())
    for (const bool turn : {false, true}) {
      PlaceOptions options;
      options.accuracy = 0.05;
      options.turn = turn;
      // Within the base, so that the floor beside it is out of reach.
      const Eigen::Vector3d size = base.vertices.colwise().maxCoeff();
      const Eigen::Vector2d low(0.75, 0.75), high = size.head<2>() - low;
      options.region = {low, {high.x(), low.y()}, high, {low.x(), high.y()}};
      options.max_cells = 3000;
      const BestPlace best = best_place(base, item, upwards, options);
      CHECK(minkowski_height(base, item, best.drop.place).to_double() ==
            Approx(best.drop.lift.to_double()).margin(1e-13));
      proven += best.proven ? 1 : 0;
      double lowest = std::numeric_limits<double>::infinity();
      for (int k = 0; k < 6; ++k) {
        const double x = low.x() + unit(random) * (high.x() - low.x()),
                     y = low.y() + unit(random) * (high.y() - low.y()), yaw = 360 * unit(random) - 180;
        const Rational height = minkowski_height(base, item, {x, y, turn ? yaw : 0});
        CHECK(height >= Rational(best.bound - 1e-14));
        lowest = std::min(lowest, height.to_double());
      }
      CHECK(best.bound <= lowest + 1e-14);
    }
  CHECK(proven >= 2);
}
