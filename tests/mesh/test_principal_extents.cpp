#include "mesh/principal_extents.h"
#include "stackabilization/core/tolerances.h"
#include "support/catch.h"
#include "support/nearly_flat.h"

using namespace stackabilization;
using detail::principal_extents;
using detail::PrincipalExtents;

TEST_CASE("the spread of points of any thickness is finite, right-angled and in order") {
  for (const auto& [name, points, dimension] : point_sets::nearly_flat_sets()) {
    INFO(name);
    const double unit = points.cwiseAbs().maxCoeff();
    for (const double relative : {0.0, tolerance::rounding, tolerance::relative, 1e-2}) {
      const PrincipalExtents spread = principal_extents(points, relative * unit);
      CHECK(spread.centre.allFinite());
      CHECK(spread.ranges.allFinite());
      CHECK((spread.axes.transpose() * spread.axes).isIdentity(1e-9));
      CHECK(spread.deviations(0) >= spread.deviations(1) * (1 - 1e-9));
      CHECK(spread.deviations(1) >= spread.deviations(2) * (1 - 1e-9));
      CHECK(spread.hull.rows() > 0);
    }
  }
}

TEST_CASE("the spread of a plate tends to that of its rectangle as it gets thinner") {
  for (const auto& [pose, rotation] : point_sets::poses())
    for (const double thickness : point_sets::thicknesses()) {
      INFO(pose << ", " << thickness);
      const Points plate = point_sets::moved(point_sets::box({3, 2, thickness}), rotation, {1, 2, 3});
      const PrincipalExtents spread = principal_extents(plate, tolerance::relative);
      CHECK((spread.centre - rotation * Eigen::Vector3d(1.5, 1, thickness / 2) - Eigen::Vector3d(1, 2, 3))
                .norm() < 1e-9);
      // Its sides add to the moments what they have of the area.
      CHECK(spread.deviations(0) == Approx(3 / std::sqrt(12.0)).epsilon(2 * thickness + 1e-8));
      CHECK(spread.deviations(1) == Approx(2 / std::sqrt(12.0)).epsilon(2 * thickness + 1e-8));
      CHECK(spread.deviations(2) <= thickness + 1e-7);  // the root of a moment of rounding
    }
}

TEST_CASE("points that are solid to the resolution but whose corners are left in a plane have a spread") {
  point_sets::Random random(78);
  for (int k = 0; k < 3000; ++k) {
    Points points = point_sets::in_ball(8, static_cast<std::uint32_t>(k));
    points.col(2) *= tolerance::relative * std::exp2(random.uniform(-2, 6));
    if (k % 2 == 0) points = (points * 0x1p34).array().round() * 0x1p-34;
    const PrincipalExtents spread = principal_extents(points, tolerance::relative);
    REQUIRE(spread.deviations.allFinite());
    REQUIRE(spread.deviations(2) < 1e-6);
  }
}

TEST_CASE("the spread of a box is that of its surface, however its points are strewn") {
  // Across an axis of length e with sides f and g lie two faces f g at e / 2; the others are spread over e.
  const Eigen::Vector3d size(3, 2, 1);
  Eigen::Vector3d deviations;
  for (int axis = 0; axis < 3; ++axis) {
    const double e = size(axis), f = size((axis + 1) % 3), g = size((axis + 2) % 3);
    const double moment = e * e * (f * g / 2 + e * (f + g) / 6);
    deviations(axis) = std::sqrt(moment / (2 * (e * f + e * g + f * g)));
  }
  point_sets::Random random(83);
  for (const auto& [pose, rotation] : point_sets::poses()) {
    INFO(pose);
    Points points(60, 3);
    points << point_sets::box(size), Points::Zero(52, 3);
    for (int row = 8; row < 60; ++row)  // dense in one corner
      for (int axis = 0; axis < 3; ++axis) points(row, axis) = size(axis) * random.uniform(0, 0.25);
    const Eigen::Vector3d shift(4, -5, 6);
    const PrincipalExtents spread =
        principal_extents(point_sets::moved(points, rotation, shift), tolerance::relative);
    CHECK((spread.centre - rotation * size / 2 - shift).norm() < 1e-12);
    CHECK((spread.deviations - deviations).norm() < 1e-12);
    CHECK(spread.hull.rows() == 8);
    for (int axis = 0; axis < 3; ++axis) {
      CHECK(std::abs(spread.axes.col(axis).dot(rotation.col(axis))) == Approx(1).epsilon(1e-12));
      CHECK(spread.ranges(axis, 0) == Approx(-size(axis) / 2).epsilon(1e-12));
      CHECK(spread.length(axis) == Approx(size(axis)).epsilon(1e-12));
    }
  }
}

TEST_CASE("the spread of a triangle, of a segment and of a point, in closed form") {
  for (const auto& [pose, rotation] : point_sets::poses()) {
    INFO(pose);
    const Eigen::Vector3d shift(1, -2, 0.5);
    Points corners(3, 3);
    corners << 0, 0, 0, 6, 0, 0, 0, 3, 0;
    const PrincipalExtents triangle =
        principal_extents(point_sets::moved(corners, rotation, shift), tolerance::relative);
    CHECK((triangle.centre - rotation * Eigen::Vector3d(2, 1, 0) - shift).norm() < 1e-12);
    // About the centroid of a right triangle with legs a and b: a^2 / 18, b^2 / 18 and -a b / 36 per area.
    const double mean = (36.0 + 9) / 36, half = std::hypot((36.0 - 9) / 36, 18.0 / 36);
    CHECK(triangle.deviations(0) == Approx(std::sqrt(mean + half)).epsilon(1e-12));
    CHECK(triangle.deviations(1) == Approx(std::sqrt(mean - half)).epsilon(1e-12));
    CHECK(triangle.deviations(2) < 1e-7);  // the root of rounding
    CHECK(triangle.length(2) < 1e-12);

    Points ends(4, 3);
    ends << 0, 0, 0, 0, 4, 0, 0, 1, 0, 0, 0.5, 0;
    const PrincipalExtents segment =
        principal_extents(point_sets::moved(ends, rotation, shift), tolerance::relative);
    CHECK((segment.centre - rotation * Eigen::Vector3d(0, 2, 0) - shift).norm() < 1e-12);
    CHECK(segment.deviations(0) == Approx(4 / std::sqrt(12.0)).epsilon(1e-12));
    CHECK(segment.deviations.tail<2>().norm() == 0);
    CHECK(segment.length(0) == Approx(4).epsilon(1e-12));

    const PrincipalExtents point =
        principal_extents(point_sets::moved(Points::Zero(3, 3), rotation, shift), tolerance::relative);
    CHECK(point.centre == shift);
    CHECK(point.deviations.norm() == 0);
    CHECK(point.ranges.norm() == 0);
  }
}
