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
