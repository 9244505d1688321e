#include <Eigen/Geometry>
#include <cmath>
#include <numbers>

#include "deformation/controllers/seam_end.h"
#include "support/catch.h"

namespace stackabilization::seam_end_test {

using namespace detail;

namespace {

/// The corners of a box.
Points box(const Eigen::Vector3d& low, const Eigen::Vector3d& high) {
  return cuboid_of({(low + high) / 2, Eigen::Matrix3d::Identity(), (high - low) / 2}).corners;
}

SeamEnd end_of_box(const Points& corners, const Points& seam) {
  Cuboid cuboid;
  cuboid.corners = corners;
  return seam_end(cuboid, corners, seam);
}

/// A straight cylinder of radius 1 along z from 0 to 10.
GeneralizedCylinder cylinder() {
  GeneralizedCylinder straight;
  straight.centres = Points::Zero(11, 3);
  straight.centres.col(2).setLinSpaced(0, 10);
  straight.radii.setOnes(11);
  return straight;
}

Points circle(double radius, double z) {
  Points points(64, 3);
  for (int k = 0; k < 64; ++k) {
    const double angle = 2 * std::numbers::pi * k / 64;
    points.row(k) << radius * std::cos(angle), radius * std::sin(angle), z;
  }
  return points;
}

}  // namespace

TEST_CASE("a leg ends at its upper side, the seat that it carries does not") {
  const Points leg = box({0, 0, 0}, {1, 1, 10}), seat = box({0, 0, 10}, {20, 10, 11});
  const Points border = box({0, 0, 10}, {1, 1, 10});
  const SeamEnd upper = end_of_box(leg, border);
  CHECK(upper.share == Approx(1));
  CHECK((upper.axis + Eigen::Vector3d::UnitZ()).norm() < 1e-14);
  CHECK(end_of_box(seat, border).share == Approx(1.0 / 20 * 1.0 / 10));
  // Half of the width, and on a side: a tenth of its length, at its whole width.
  CHECK(end_of_box(leg, box({0, 0, 10}, {0.5, 1, 10})).share == Approx(0.5));
  const SeamEnd side = end_of_box(leg, box({0, 1, 8}, {1, 1, 9}));
  CHECK(side.share == Approx(0.1));
  CHECK((side.axis + Eigen::Vector3d::UnitY()).norm() < 1e-14);
  // Half-way from the middle to the end.
  CHECK(end_of_box(leg, box({0, 0, 7.5}, {1, 1, 7.5})).share == Approx(0.5));
}

TEST_CASE("how a part ends depends on no pose and no scale") {
  const Points leg = box({0, 0, 0}, {1, 2, 10}), border = box({0.2, 0, 10}, {1, 1.5, 10});
  const SeamEnd end = end_of_box(leg, border);
  const Eigen::Matrix3d turn =
      Eigen::AngleAxisd(0.7, Eigen::Vector3d(1, 2, -0.5).normalized()).toRotationMatrix();
  const auto posed = [&](const Points& points) -> Points {
    return 3 * points * turn.transpose() + Eigen::RowVector3d(4, -5, 6).replicate(points.rows(), 1);
  };
  const SeamEnd now = end_of_box(posed(leg), posed(border));
  CHECK(now.share == Approx(end.share).epsilon(1e-12));
  CHECK((now.axis - turn * end.axis).norm() < 1e-12);
}

TEST_CASE("a sheet ends at a line") {
  const Points sheet = box({0, 0, 0}, {4, 1, 0});
  Cuboid cuboid;
  cuboid.corners = box({0, 0, -0.5}, {4, 1, 0.5});
  CHECK(seam_end(cuboid, sheet, box({4, 0, 0}, {4, 1, 0})).share == Approx(1));
  CHECK(seam_end(cuboid, sheet, box({4, 0, 0}, {4, 0.25, 0})).share == Approx(0.25));
}

TEST_CASE("a cylinder ends at its first and last sections, a closed one nowhere") {
  const GeneralizedCylinder straight = cylinder();
  const SeamEnd upper = seam_end(straight, circle(1, 10), circle(1, 10));
  CHECK(upper.share == Approx(1));
  CHECK((upper.axis + Eigen::Vector3d::UnitZ()).norm() < 1e-14);
  CHECK((seam_end(straight, circle(1, 0), circle(1, 0)).axis - Eigen::Vector3d::UnitZ()).norm() < 1e-14);
  CHECK(seam_end(straight, circle(1, 0), circle(0.5, 0)).share == Approx(0.25));
  CHECK(seam_end(straight, circle(1, 0), circle(1, 5)).share == 0);
  GeneralizedCylinder ring;
  ring.centres = circle(5, 0);
  ring.radii.setOnes(64);
  ring.closed = true;
  CHECK(seam_end(ring, ring.centres, box({4, 0, -1}, {6, 0, 1})).share == 0);
}

}  // namespace stackabilization::seam_end_test
