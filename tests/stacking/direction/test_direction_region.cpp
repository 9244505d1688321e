#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "stackabilization/core/errors.h"
#include "stackabilization/stacking/direction_region.h"
#include "support/catch.h"
#include "support/variants.h"

namespace stackabilization::direction_region_test {

using std::numbers::pi;

namespace {

const Eigen::Vector3d x = Eigen::Vector3d::UnitX(), y = Eigen::Vector3d::UnitY(),
                      z = Eigen::Vector3d::UnitZ();

double angle(const Eigen::Vector3d& a, const Eigen::Vector3d& b) {
  return std::atan2(a.cross(b).norm(), a.dot(b));
}

/// Between lines: r and -r are one direction.
double line_angle(const Eigen::Vector3d& a, const Eigen::Vector3d& b) {
  return std::min(angle(a, b), pi - angle(a, b));
}

DirectionRegion sphere() {
  return {std::nullopt, std::nullopt};
}
DirectionRegion cone(const Eigen::Vector3d& axis, double half_angle) {
  return {DirectionCone{axis, half_angle}, std::nullopt};
}
DirectionRegion plane(const Eigen::Vector3d& normal) {
  return {std::nullopt, normal};
}

}  // namespace

TEST_CASE("of r and -r the one whose last component is positive stands for both") {
  CHECK(sphere().member({1, 2, 3}) == Eigen::Vector3d(1, 2, 3));
  CHECK(sphere().member({1, 2, -3}) == Eigen::Vector3d(-1, -2, 3));
  CHECK(sphere().member({1, -2, 0}) == Eigen::Vector3d(-1, 2, 0));
  CHECK(sphere().member({-1, 0, 0}) == Eigen::Vector3d(1, 0, 0));
  const Eigen::Vector3d found = *sphere().member({0, -2, 0});
  CHECK_FALSE(std::signbit(found.x()));
  CHECK_FALSE(std::signbit(found.z()));
  CHECK(sphere().nearest({0, 3, -4})->isApprox(Eigen::Vector3d(0, -0.6, 0.8), 1e-15));
}

TEST_CASE("a cone holds what is within its half angle, on the side of its axis") {
  const DirectionRegion down = cone(-2 * z, 0.25);
  const auto at = [](double tilt) { return Eigen::Vector3d(std::sin(tilt), 0, std::cos(tilt)); };
  CHECK(down.member(3 * at(0.2))->isApprox(-3 * at(0.2), 1e-15));
  CHECK(down.member(-at(0.2))->isApprox(-at(0.2), 1e-15));
  CHECK(down.member(at(0.25)));
  CHECK_FALSE(down.member(at(0.25 + 1e-8)));
  CHECK_FALSE(down.member(x));
  CHECK(cone(z, pi / 2).member(x));  // a half space
}

TEST_CASE(
    "the direction of a cone nearest to one outside lies on its rim, in the plane of that and the axis") {
  solids::Random random(3);
  for (int trial = 0; trial < 200; ++trial) {
    const Eigen::Vector3d axis = random.on_sphere(), given = random.on_sphere();
    const double half = random.uniform(0.05, 1.2), off = line_angle(axis, given);
    const Eigen::Vector3d nearest = *cone(axis, half).nearest(2 * given);
    CHECK(nearest.norm() == Approx(1).epsilon(1e-14));
    CHECK(angle(nearest, axis) == Approx(std::min(off, half)).margin(1e-12));
    CHECK(line_angle(nearest, given) == Approx(std::max(0.0, off - half)).margin(1e-7));
  }
}

TEST_CASE("the direction of a plane nearest to another is its projection, and there is none to the normal") {
  solids::Random random(5);
  for (int trial = 0; trial < 100; ++trial) {
    const Eigen::Vector3d normal = random.on_sphere(), given = random.on_sphere();
    const Eigen::Vector3d nearest = *plane(3 * normal).nearest(given);
    CHECK(std::abs(nearest.dot(normal)) < 1e-12);
    CHECK(nearest.norm() == Approx(1).epsilon(1e-14));
    CHECK(line_angle(nearest, given) == Approx(pi / 2 - line_angle(normal, given)).margin(1e-7));
    CHECK(plane(normal).member(nearest));
  }
  CHECK_FALSE(plane(z).nearest(z));
  CHECK_FALSE(plane(z).nearest({1e-10, 0, 1}));
  for (const Eigen::Vector3d& normal : {z, Eigen::Vector3d(-z)})
    CHECK_FALSE(plane(normal).member({1, 0, 1e-8}));
}

TEST_CASE("of cone and plane only what is in both counts") {
  const DirectionRegion both(DirectionCone{z, 0.3}, x);
  CHECK(both.member(z));
  CHECK(both.member({0, std::sin(0.3), std::cos(0.3)}));
  CHECK_FALSE(both.member({0, std::sin(0.31), std::cos(0.31)}));
  CHECK_FALSE(both.member({0.1, 0, 1}));
  CHECK(both.nearest({0.2, 0, 1})->isApprox(z, 1e-15));
  CHECK_FALSE(both.nearest({0, 1, 1}));
  CHECK_FALSE(both.nearest(x));
  // A plane across the axis of a cone shares nothing with it.
  CHECK(DirectionRegion(DirectionCone{z, 0.3}, z).samples(0.05).empty());
}

TEST_CASE("samples lie in their region and leave no gap in it") {
  solids::Random random(7);
  const Eigen::Vector3d axis = Eigen::Vector3d(1, -2, 2) / 3, across = Eigen::Vector3d(2, 2, 1) / 3;
  constexpr double spacing = 0.05;
  const std::vector<DirectionRegion> regions = {sphere(), cone(axis, 0.5), plane(across),
                                                DirectionRegion(DirectionCone{axis, 0.5}, across)};
  for (const DirectionRegion& region : regions) {
    const std::vector<Eigen::Vector3d> samples = region.samples(spacing);
    REQUIRE_FALSE(samples.empty());
    for (const Eigen::Vector3d& sample : samples) {
      CHECK(sample.norm() == Approx(1).epsilon(1e-14));
      CHECK((*region.member(sample) - sample).norm() < 1e-15);
    }
    for (int trial = 0; trial < 300; ++trial) {
      const auto inside = region.nearest(random.on_sphere());
      if (!inside) continue;
      double least = pi;
      for (const Eigen::Vector3d& sample : samples) least = std::min(least, line_angle(sample, *inside));
      CHECK(least < 1.2 * spacing);
    }
  }
  // One per square of the spacing: the area of a cap is 2 pi (1 - cos).
  CHECK(sphere().samples(spacing).size() == Approx(2 * pi / (spacing * spacing)).epsilon(0.01));
  CHECK(cone(axis, 0.5).samples(spacing).size() ==
        Approx(2 * pi * (1 - std::cos(0.5)) / (spacing * spacing)).epsilon(0.01));
  // Narrow cones are sampled at a sixth of their width.
  CHECK(cone(axis, 0.001).samples(spacing).size() == Approx(9 * pi).margin(1));
}

TEST_CASE("a half circle goes around its normal in equal steps, once over every line") {
  const Eigen::Vector3d normal = Eigen::Vector3d(1, 2, 2);
  const std::vector<Eigen::Vector3d> directions = half_circle(normal, 0.1);
  REQUIRE(directions.size() == 32);  // pi / 0.1, rounded up
  for (std::size_t k = 0; k < directions.size(); ++k) {
    CHECK(std::abs(directions[k].dot(normal)) < 1e-14);
    CHECK(line_angle(directions[k], directions[(k + 1) % 32]) == Approx(pi / 32).epsilon(1e-12));
  }
}

TEST_CASE("regions that make no sense are refused") {
  for (const double half : {0.0, -0.1, 1.6, std::numeric_limits<double>::quiet_NaN()})
    CHECK_THROWS_AS(cone(z, half), UsageError);
  CHECK_THROWS_AS(cone(Eigen::Vector3d::Zero(), 0.3), UsageError);
  CHECK_THROWS_AS(plane(Eigen::Vector3d::Zero()), UsageError);
  CHECK_NOTHROW(cone(y, pi / 2));
}

}  // namespace stackabilization::direction_region_test
