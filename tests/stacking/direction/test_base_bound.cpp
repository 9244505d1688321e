#include <cmath>
#include <numbers>
#include <vector>

#include "stackabilization/core/rational.h"
#include "stackabilization/mesh/boxes.h"
#include "stacking/direction/base_bound.h"
#include "support/catch.h"
#include "support/point_sets.h"
#include "support/solids.h"
#include "support/variants.h"

using namespace stackabilization;
using detail::min_base;

namespace {

/// A unit vector at the angle from the unit vector `from`, turned about it at random.
Eigen::Vector3d beside(const Eigen::Vector3d& from, double angle, point_sets::Random& random) {
  const Frame frame = frame_of(Direction(from));
  const double turn = random.uniform(0, 2 * std::numbers::pi);
  return frame.to_world(
      {std::sin(angle) * std::cos(turn), std::sin(angle) * std::sin(turn), std::cos(angle)});
}

std::vector<HullSupport> hulls() {
  std::vector<HullSupport> result;
  for (const Shape& shape :
       {solids::box({1, 2, 5}), solids::cylinder(1, 0.2, 32), solids::frustum_shell({.segments = 24}),
        solids::tetrahedron({Eigen::Vector3d(0, 0, 0), {3, 0, 1}, {0, 1, 0}, {1, 1, 2}}),
        solids::triangle_soup({.seed = 8, .count = 30})})
    result.emplace_back(shape);
  return result;
}

}  // namespace

TEST_CASE("no rectangle around the projection along a direction within the angle is smaller than the bound") {
  point_sets::Random random(5);
  for (const HullSupport& hull : hulls())
    for (const double angle : {1e-6, 1e-3, 0.05, 0.3, 1.0})
      for (int k = 0; k < 10; ++k) {
        const Eigen::Vector3d middle = random.unit();
        const double bound = min_base(hull, Direction(middle), angle);
        CHECK(bound >= 0);
        for (int trial = 0; trial < 20; ++trial) {
          const double share = std::sqrt(random.uniform(0, 1));
          CHECK(hull.minimal_rectangle_area(Direction(beside(middle, share * angle, random))) >= bound);
        }
      }
}

TEST_CASE("the bound of a base comes to the rectangle as the angle goes to 0") {
  point_sets::Random random(6);
  for (const HullSupport& hull : hulls())
    for (int k = 0; k < 10; ++k) {
      const Direction middle(random.unit());
      const double area = hull.minimal_rectangle_area(middle);
      CHECK(min_base(hull, middle, 0) == Approx(area).epsilon(1e-9));
      CHECK(min_base(hull, middle, 1e-6) == Approx(area).epsilon(1e-4));
      CHECK(min_base(hull, middle, 1e-3) <= min_base(hull, middle, 1e-6));
    }
}

TEST_CASE("the base of a body that is seen along its own axis is bounded to the second order") {
  // Corners of top and bottom are seen in one place, so no width of a turned box is smaller to first order.
  const HullSupport box(solids::box({1, 2, 5}));
  for (const double angle : {1e-2, 1e-3})
    CHECK(min_base(box, Direction(0, 0, 1), angle) >= 2 - 5 * angle * angle);
}

TEST_CASE("the bound of a base is not above the area by a rounding") {
  // Far from the origin, where the coordinates have less room for the sides.
  point_sets::Random random(8);
  for (const double away : {0.0, 100.0})
    for (int k = 0; k < 300; ++k) {
      const Eigen::Vector3d low = Eigen::Vector3d::Constant(away) + random.vector(1),
                            high = low + random.vector(0.5) + Eigen::Vector3d::Ones();
      const HullSupport hull(solids::box(low, high));
      const Rational area =
          (Rational(high.x()) - Rational(low.x())) * (Rational(high.y()) - Rational(low.y()));
      const double bound = min_base(hull, Direction(0, 0, 1), 0);
      REQUIRE(Rational(bound) <= area);
      CHECK(bound == Approx(area.to_double()).epsilon(1e-6));
    }
}

TEST_CASE("a flat set seen edge on has no base") {
  CHECK(min_base(HullSupport(solids::box({1, 1, 0})), Direction(1, 0, 0), 0.1) == 0);
}
