#include <Eigen/Geometry>
#include <cmath>
#include <limits>
#include <numbers>

#include "stackabilization/core/errors.h"
#include "stackabilization/stacking/static_stability.h"
#include "stackabilization/stacking/tolerances.h"
#include "support/catch.h"
#include "support/directions.h"
#include "support/solids.h"
#include "support/variants.h"

namespace stackabilization {
namespace {

double degrees(double radians) {
  return radians * 180 / std::numbers::pi;
}

StaticStabilityOptions standing_copies(int count) {
  StaticStabilityOptions options;
  options.copies = count;
  return options;
}

/// A foot [0, 1] x [0, 4] with an arm [1, 10] x [3, 4] in the x, z plane.
Shape gallows() {
  return solids::extruded_profile({{0, 0}, {1, 0}, {1, 3}, {10, 3}, {10, 4}, {0, 4}}, 6);
}

TEST_CASE("n cubes topple at atan(1 / n)") {
  const Shape cube = solids::box(Eigen::Vector3d(2, 2, 2));
  for (const int n : {1, 2, 3, 10, 1000000}) {
    const StaticStability result = static_stability(cube, upwards, standing_copies(n));
    INFO(n);
    CHECK(result.stands);
    CHECK(result.of_solid);
    CHECK(result.tipping_degrees == Approx(degrees(std::atan(1.0 / n))));
    CHECK(result.weakest_copy == 0);
    CHECK((result.centre_of_mass - Eigen::Vector3d(1, 1, 1)).norm() < 1e-12);
  }
}

TEST_CASE("cubes along a leaning direction drift until they topple, with gravity straight down") {
  const Shape cube = solids::box(Eigen::Vector3d(2, 2, 2));
  const double lean = 0.1;  // tangent: each copy is 0.2 further to the side
  for (const int n : {2, 5, 8, 9, 11}) {
    StaticStabilityOptions options = standing_copies(n);
    options.up = Eigen::Vector3d(0, 0, 3);
    const StaticStability result = static_stability(cube, Direction(lean, 0, 1), options);
    // Over the edge of the ground, and over the edge that the lowest two copies share.
    const double ground = std::atan2(1 - (n - 1) * lean, n), joint = std::atan2(1 - n * lean, n - 1);
    INFO(n);
    CHECK(result.tipping_degrees == Approx(degrees(std::min(ground, joint))));
    CHECK(result.stands == (n < 10));
    CHECK(result.weakest_copy == (joint < ground ? 1 : 0));
    // Seen along the direction nothing drifts: that was the stack on a slope.
    options.up.reset();
    CHECK(static_stability(cube, Direction(lean, 0, 1), options).tipping_degrees !=
          Approx(result.tipping_degrees));
  }
  StaticStabilityOptions options;
  options.up = Eigen::Vector3d(0, 0, 1);
  CHECK_THROWS_AS(static_stability(cube, Direction(1, 0, 0), options), UsageError);
  CHECK_THROWS_AS(static_stability(cube, Direction(0, 0, -1), options), UsageError);
}

TEST_CASE("with friction cubes slide before they topple") {
  const Shape cube = solids::box(Eigen::Vector3d(2, 2, 2));
  for (const int n : {2, 3, 10})
    for (const double friction : {0.0, 0.05, 0.25, 3.0}) {
      StaticStabilityOptions options = standing_copies(n);
      options.friction = friction;
      const StaticStability result = static_stability(cube, upwards, options);
      INFO(n << " copies, friction " << friction);
      // The ground does not let them slide. The cones of friction are pyramids of 32 sides.
      const double topples = std::atan(1.0 / n), slides = std::atan(friction),
                   slides_sooner = std::atan(friction * std::cos(std::numbers::pi / 32));
      CHECK(result.tipping_degrees <= degrees(std::min(topples, slides)) + 1e-6);
      CHECK(result.tipping_degrees >=
            degrees(std::min(topples, slides_sooner)) * (1 - tolerance::tilt) - 1e-6);
      CHECK(result.stands == (friction > 0));
      CHECK(needed_friction(cube, upwards, options) == 0);
      CHECK((result.weakest_copy > 0) == (slides < topples));
    }
  StaticStabilityOptions options;
  for (const double bad : {-1.0, std::nan("")}) {
    options.friction = bad;
    CHECK_THROWS_AS(static_stability(cube, upwards, options), UsageError);
    CHECK_THROWS_AS(needed_friction(cube, upwards, options), UsageError);
  }
}

TEST_CASE("copies on a slope need its tangent as friction, and more than any where they topple") {
  StaticStabilityOptions options;
  options.friction = 0.3;
  for (const double slope : {0.1, 0.25, 0.6}) {
    const Shape block = solids::extruded_profile({{0, 0}, {2, 2 * slope}, {2, 2 * slope + 1}, {0, 1}}, 3);
    for (const int n : {2, 3}) {
      options.copies = n;
      INFO(slope << ", " << n << " copies");
      CHECK(needed_friction(block, upwards, options) == Approx(slope).epsilon(2e-6));
    }
  }
  options.copies = 2;
  const StaticStability toppling = static_stability(gallows(), upwards, options);
  CHECK(needed_friction(gallows(), upwards, options) == std::numeric_limits<double>::infinity());
  CHECK_FALSE(toppling.stands);
}

TEST_CASE("a blade topples over its ends, whatever rounding makes of its edge") {
  // Wedges on an edge along x from 0 to 1, their centre of mass beyond it at x = 2.
  for (const double bend : {0.0, 1e-16, 1e-13, 1e-10}) {
    const Shape foot = solids::tetrahedron({Eigen::Vector3d(0, 0, 0), Eigen::Vector3d(1, 0, 0),
                                            Eigen::Vector3d(0.5, bend, 0), Eigen::Vector3d(3, 0.5, 4)});
    const Shape head = solids::box({3, -1, 4}, {5, 1, 5});
    INFO(bend);
    CHECK(static_stability(concatenate(foot, head), upwards, standing_copies(1)).tipping_degrees < -10);
  }
}

TEST_CASE("standing does not depend on pose, unit, order or orientation of triangles") {
  const Shape shape = solids::frustum_shell({});
  const StaticStability expected = static_stability(shape, upwards, standing_copies(3));
  REQUIRE(expected.stands);
  for (const std::uint64_t seed : {1u, 2u, 3u}) {
    const Eigen::Matrix3d turn = solids::random_rotation(seed);
    const Eigen::Vector3d shift(100, -7, 3);
    Shape moved = transformed(solids::permuted(shape, seed), 0.01 * turn, shift);
    if (seed == 2) moved = solids::flipped(moved);
    const StaticStability result = static_stability(moved, Direction(3 * turn.col(2)), standing_copies(3));
    CHECK(result.tipping_degrees == Approx(expected.tipping_degrees).epsilon(1e-6));
    CHECK(result.weakest_copy == expected.weakest_copy);
    CHECK((result.centre_of_mass - (0.01 * turn * expected.centre_of_mass + shift)).norm() < 1e-9);
  }
}

/// Integral of r(z)^2 z^power over [low, high] for a radius that runs from a to b; Simpson is exact for it.
double frustum_moment(double a, double b, const Range& z, int power) {
  const auto at = [&](double t) {
    return std::pow(std::lerp(a, b, t), 2) * std::pow(std::lerp(z.low, z.high, t), power);
  };
  return z.length() / 6 * (at(0) + 4 * at(0.5) + at(1));
}

TEST_CASE("cups stand in each other on the foot, down to which the least tilt is known") {
  const solids::FrustumShell cup;
  const Shape shape = solids::frustum_shell(cup);
  const auto moment = [&](int power) {
    return frustum_moment(cup.outer_bottom, cup.outer_top, {0, cup.height}, power) -
           frustum_moment(cup.inner_bottom, cup.inner_top, {cup.floor, cup.height}, power);
  };
  const double height = moment(1) / moment(0), foot = cup.outer_bottom * std::cos(std::numbers::pi / 64);
  StaticStabilityOptions options;
  options.band = 1e-7;
  for (const int n : {1, 2, 5}) {
    options.copies = n;
    const StaticStability result = static_stability(shape, upwards, options);
    CHECK(result.centre_of_mass.z() == Approx(height));
    const double lift = (n - 1) / 2.0 * solids::frustum_shell_f_max(cup);
    CHECK(result.tipping_degrees == Approx(degrees(std::atan2(foot, height + lift))));
    CHECK(result.weakest_copy == 0);
  }
}

TEST_CASE("an overhanging shape topples, alone and where it stands on itself") {
  const double x = (4 * 0.5 + 9 * 5.5) / 13, z = (4 * 2 + 9 * 3.5) / 13;
  for (const int n : {1, 2, 3}) {
    const StaticStability result = static_stability(gallows(), upwards, standing_copies(n));
    CHECK_FALSE(result.stands);
    CHECK(result.centre_of_mass.x() == Approx(x));
    CHECK(result.tipping_degrees == Approx(degrees(std::atan2(1 - x, z))));
    CHECK(result.weakest_copy == n - 1);  // with the least height, so the most negative tilt
  }
  // Sideways, a copy lies on the whole of its back: r = -x, foot wall down.
  CHECK(static_stability(gallows(), Direction(1, 0, 0), standing_copies(1)).stands);
}

TEST_CASE("a narrow ledge can be worse than the ground") {
  // A mushroom on a broad base: copies rest with the base on a cap of half the width.
  const Shape shape =
      solids::extruded_profile({{-4, 0}, {4, 0}, {4, 1}, {1, 1}, {1, 6}, {-1, 6}, {-1, 1}, {-4, 1}}, 20);
  const StaticStability result = static_stability(shape, upwards, standing_copies(2));
  const double z = (8 * 0.5 + 10 * 3.5) / 18;
  CHECK(result.stands);
  CHECK(result.weakest_copy == 1);
  CHECK(result.tipping_degrees == Approx(degrees(std::atan2(1, z))));
}

TEST_CASE("a copy that hangs beside its support falls at any tilt") {
  // A plate under a slanted bar with an arm high up beside it, on which copies rest: 2 thick, the most.
  const Shape hanger =
      solids::extruded_profile({{0, 0}, {10, 0}, {10, 1}, {0, 1}, {-2, 12}, {-4, 12}, {-4, 10}, {-2, 10}}, 6);
  const StaticStability result = static_stability(hanger, upwards, standing_copies(2));
  CHECK(result.tipping_degrees == Approx(-90));
  CHECK(result.weakest_copy == 1);
  CHECK(static_stability(hanger, upwards, standing_copies(1)).stands);
}

TEST_CASE("supports that are points or lines carry nothing") {
  const auto tip_down = [](double x) {
    return solids::tetrahedron({Eigen::Vector3d(x, 0, 0), Eigen::Vector3d(2, 0, 3), Eigen::Vector3d(-1, 2, 3),
                                Eigen::Vector3d(-1, -2, 3)});
  };
  CHECK(static_stability(tip_down(0), upwards, standing_copies(1)).tipping_degrees == 0);
  CHECK_FALSE(static_stability(tip_down(0), upwards, standing_copies(1)).stands);
  CHECK(static_stability(tip_down(1), upwards, standing_copies(1)).tipping_degrees ==
        Approx(-degrees(std::atan2(0.75, 2.25))));
  const auto edge_down = [](double x) { return solids::extruded_profile({{x, 0}, {1, 2}, {-1, 2}}, 5); };
  CHECK(static_stability(edge_down(0), upwards, standing_copies(1)).tipping_degrees == 0);
  CHECK_FALSE(static_stability(edge_down(0), upwards, standing_copies(1)).stands);
  CHECK(static_stability(edge_down(0.6), upwards, standing_copies(1)).tipping_degrees ==
        Approx(-degrees(std::atan2(0.4, 4.0 / 3))));
}

TEST_CASE("a mass beyond the end of a line falls over that end") {
  const Shape keel = solids::tetrahedron({Eigen::Vector3d(0, 0, 0), Eigen::Vector3d(0, 1, 0),
                                          Eigen::Vector3d(1, 6, 2), Eigen::Vector3d(-1, 6, 2)});
  CHECK(static_stability(keel, upwards, standing_copies(1)).tipping_degrees ==
        Approx(-degrees(std::atan2(2.25, 1))));
}

TEST_CASE("open surfaces and sheets with two sides have their mass in the area") {
  Shape open = solids::box(Eigen::Vector3d(2, 2, 2));
  Triangles lidless(0, 3);
  for (Eigen::Index t = 0; t < open.triangle_count(); ++t) {
    if ((open.corner(t, 0).z() + open.corner(t, 1).z() + open.corner(t, 2).z()) == 6) continue;
    lidless.conservativeResize(lidless.rows() + 1, 3);
    lidless.bottomRows(1) = open.triangles.row(t);
  }
  REQUIRE(lidless.rows() == 10);
  const StaticStability crate =
      static_stability(make_shape(open.vertices, lidless), upwards, standing_copies(1));
  CHECK_FALSE(crate.of_solid);
  CHECK(crate.centre_of_mass.z() == Approx(4 * 1.0 / 5));
  CHECK(crate.tipping_degrees == Approx(degrees(std::atan2(1, 0.8))));

  Points corners(3, 3);
  corners << 0, 0, 0, 3, 0, 0, 0, 3, 0;
  Triangles both(2, 3);
  both << 0, 1, 2, 0, 2, 1;
  const StaticStability sheet = static_stability(make_shape(corners, both), upwards, standing_copies(1));
  CHECK_FALSE(sheet.of_solid);
  CHECK((sheet.centre_of_mass - Eigen::Vector3d(1, 1, 0)).norm() < 1e-12);
  CHECK(sheet.tipping_degrees == Approx(90));
}

TEST_CASE("cavities are empty, bodies count whichever way they are turned") {
  const Shape outer = solids::box(Eigen::Vector3d(4, 4, 4));
  const Shape hole = solids::flipped(solids::box({1, 1, 0.5}, {3, 3, 1.5}));
  const Shape kernel = solids::box({1.5, 1.5, 0.75}, {2.5, 2.5, 1.25});
  const double hollow = 64 * 2 - 4 * 1;
  const Shape cavity = concatenate(outer, hole), filled = concatenate(cavity, kernel);
  CHECK(static_stability(cavity, upwards, standing_copies(1)).centre_of_mass.z() == Approx(hollow / 60));
  CHECK(static_stability(solids::flipped(cavity), upwards, standing_copies(1)).centre_of_mass.z() ==
        Approx(hollow / 60));
  CHECK(static_stability(filled, upwards, standing_copies(1)).centre_of_mass.z() ==
        Approx((hollow + 0.5) / 60.5));
  for (const Shape& turned : {filled, concatenate(cavity, solids::flipped(kernel))})
    CHECK(static_stability(solids::flipped(turned), upwards, standing_copies(1)).centre_of_mass.z() ==
          Approx((hollow + 0.5) / 60.5));
  const Shape beside = solids::flipped(solids::box({4, 0, 0}, {5, 4, 2}));
  CHECK(static_stability(concatenate(outer, beside), upwards, standing_copies(1)).centre_of_mass.z() ==
        Approx((64 * 2 + 8 * 1) / 72.0));
}

TEST_CASE("standing refuses what cannot be asked") {
  const Shape cube = solids::box(Eigen::Vector3d(1, 1, 1));
  CHECK_THROWS_AS(static_stability(cube, upwards, standing_copies(0)), UsageError);
  for (const double band : {0.0, 1.0, -0.1, std::numeric_limits<double>::quiet_NaN()}) {
    StaticStabilityOptions options;
    options.band = band;
    CHECK_THROWS_AS(static_stability(cube, upwards, options), UsageError);
  }
  CHECK_THROWS_AS(static_stability(Shape{}, upwards), InputError);
  Triangles one(1, 3);
  one << 0, 1, 2;
  Points straight(3, 3), upright(3, 3);
  straight << 0, 0, 0, 1, 1, 1, 2, 2, 2;
  upright << 0, 0, 0, 1, 0, 0, 0, 0, 1;
  CHECK_THROWS_AS(static_stability(make_shape(straight, one), upwards, standing_copies(1)), InputError);
  CHECK_THROWS_AS(static_stability(make_shape(upright, one), upwards, standing_copies(2)), InputError);
  CHECK_FALSE(static_stability(make_shape(upright, one), upwards, standing_copies(1)).stands);
}

}  // namespace
}  // namespace stackabilization
