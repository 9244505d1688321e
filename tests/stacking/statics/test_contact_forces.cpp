#include <Eigen/Geometry>
#include <cmath>
#include <limits>
#include <numbers>
#include <vector>

#include "stackabilization/stacking/tolerances.h"
#include "stacking/statics/contact_forces.h"
#include "support/catch.h"

namespace stackabilization::detail {
namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();
/// Part of a margin that is found at least.
constexpr double found = 1 - tolerance::tilt;
/// Part of the friction that a pyramid of 32 sides keeps in every direction.
const double kept = std::cos(std::numbers::pi / 32);

/// The corners of a square of half width 1 about (x, 0, 0).
std::vector<Hold> square(double x = 0, const Eigen::Vector3d& normal = Eigen::Vector3d::UnitZ()) {
  std::vector<Hold> holds;
  for (const double side : {-1.0, 1.0})
    for (const double front : {-1.0, 1.0}) holds.push_back({{x + side, front, 0}, normal});
  return holds;
}

/// Points around a cone that opens upwards, at the height 0 and the distance 1 of its axis.
std::vector<Hold> ring(double draft, int count) {
  std::vector<Hold> holds;
  for (int k = 0; k < count; ++k) {
    const double angle = 2 * std::numbers::pi * k / count;
    const Eigen::Vector3d out(std::cos(angle), std::sin(angle), 0);
    holds.push_back({out, std::sin(draft) * Eigen::Vector3d::UnitZ() - std::cos(draft) * out});
  }
  return holds;
}

TEST_CASE("a body on level ground slides at the angle of friction, or topples before") {
  for (const double height : {0.5, 1.0, 4.0, 20.0})
    for (const double friction : {0.0, 0.1, 0.4, 2.0}) {
      INFO(height << " high, friction " << friction);
      const ContactForces forces(square(), friction, {0, 0, height});
      CHECK(forces.balance());
      const double margin = forces.tilt_margin(), topples = 1 / height;
      CHECK(margin <= std::min(friction, topples) * (1 + 1e-9));
      CHECK(margin >= found * std::min(friction * kept, topples) - 1e-9);
    }
}

TEST_CASE("a body whose mass is beside its support lacks the tilt that brings it back") {
  const ContactForces forces(square(3), 5, {0, 0, 4});
  CHECK_FALSE(forces.balance());
  CHECK(forces.tilt_margin() == Approx(-0.5));  // 2 beside the square, 4 above it
  // Held at one point, or at none.
  CHECK(ContactForces({{{0, 0, 0}, {0, 0, 1}}}, 0.5, {0, 0, 1}).balance());
  CHECK(ContactForces({{{0, 0, 0}, {0, 0, 1}}}, 0.5, {0, 0, 1}).tilt_margin() == 0);
  CHECK(ContactForces({}, 0.5, {0, 0, 1}).tilt_margin() == -infinity);
  CHECK_FALSE(ContactForces({}, 0.5, {0, 0, 1}).balance());
}

TEST_CASE("a slope holds a body when its friction is at least the tangent of the slope") {
  for (const double slope : {0.05, 0.3, 1.0}) {
    const Eigen::Vector3d normal = Eigen::Vector3d(-slope, 0, 1).normalized();
    std::vector<Hold> holds = square(0, normal);
    for (Hold& hold : holds) hold.point.z() = slope * hold.point.x();
    INFO(slope);
    CHECK(ContactForces(holds, slope * (1 + 1e-8), {0, 0, 0.1}).balance());
    CHECK_FALSE(ContactForces(holds, slope * (1 - 1e-8), {0, 0, 0.1}).balance());
    CHECK(ContactForces(holds, slope / 2, {0, 0, 0.1}).tilt_margin() < 0);
  }
}

TEST_CASE("without friction a cone holds a body up to tilts by the slope of its sides") {
  // The normals meet at the centre of mass: no force turns the body.
  for (const int count : {3, 4, 6, 24})
    for (const double draft : {0.2, 0.7}) {
      INFO(count << " points, draft " << draft);
      const ContactForces forces(ring(draft, count), 0, {0, 0, std::tan(draft)});
      const double slope = std::cos(std::numbers::pi / count) / std::tan(draft);
      CHECK(forces.tilt_margin() <= slope * (1 + 1e-6));
      CHECK(forces.tilt_margin() >= found * slope);
    }
}

TEST_CASE("walls that clamp a body hold it at any tilt") {
  const std::vector<Hold> clamp = ring(0, 8);
  CHECK(ContactForces(clamp, 0.5, {0, 0, 0}).tilt_margin() == Approx(ContactForces::max_tilt));
  CHECK_FALSE(ContactForces(clamp, 0, {0, 0, 0}).balance());
}

TEST_CASE("a cone grips with the friction along its sides less their slope") {
  for (const int count : {3, 8, 40})
    for (const double draft : {0.0, 0.1, 0.5})
      for (const double friction : {0.0, 0.2, 0.6}) {
        INFO(count << " points, draft " << draft << ", friction " << friction);
        const auto grip = ContactForces(ring(draft, count), friction, {0, 0, 2}).grip({0, 0, 1});
        REQUIRE(grip);
        CHECK(grip->resisted == Approx(friction * std::cos(draft) - std::sin(draft)).margin(1e-12));
        CHECK(grip->press == Approx(friction * std::cos(draft) + std::sin(draft)).margin(1e-12));
        CHECK(grip->normal_forces.sum() == Approx(1));
      }
}

TEST_CASE("a wall on one side grips nothing, and a level floor pushes only") {
  const std::vector<Hold> wall = {{{1, -1, 0}, {-1, 0, 0}}, {{1, 1, 0}, {-1, 0, 0}}};
  CHECK_FALSE(ContactForces(wall, 0.5, {0, 0, 0}).grip({0, 0, 1}));
  const auto floor = ContactForces(square(), 0.5, {0, 0, 1}).grip({0, 0, 1});
  REQUIRE(floor);
  CHECK(floor->resisted <= -1 + 1e-9);
  // Two walls grip, whatever stands between them on a floor.
  std::vector<Hold> slot = square();
  for (const double side : {-1.0, 1.0})
    for (const double front : {-1.0, 1.0}) slot.push_back({{side, front, 1}, {-side, 0, 0}});
  const auto grip = ContactForces(slot, 0.5, {0, 0, 1}).grip({0, 0, 1});
  REQUIRE(grip);
  CHECK(grip->resisted == Approx(0.5));
  CHECK(grip->normal_forces.head<4>().sum() == Approx(0).margin(1e-9));
}

}  // namespace
}  // namespace stackabilization::detail
