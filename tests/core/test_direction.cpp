#include <Eigen/Geometry>
#include <cmath>
#include <limits>

#include "stackabilization/core/direction.h"
#include "stackabilization/core/direction_text.h"
#include "stackabilization/core/errors.h"
#include "support/catch.h"

using namespace stackabilization;

TEST_CASE("a direction refuses what is not a direction") {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  CHECK_THROWS_AS(Direction(0, 0, 0), UsageError);
  CHECK_THROWS_AS(Direction(nan, 0, 1), UsageError);
  CHECK_THROWS_AS(Direction(1e300, 0, 0), UsageError);
  CHECK_THROWS_AS(Direction(1e-300, 0, 0), UsageError);
}

TEST_CASE("a direction takes numbers from 1e-150 to 1e150") {
  for (const double size : {1e-150, 1e150}) {
    const Direction direction(0, size, 0);
    CHECK(direction.length() == Approx(size).epsilon(1e-15));
    CHECK((direction.unit() - Eigen::Vector3d::UnitY()).norm() <= 1e-15);
  }
}

TEST_CASE("the frame of a direction is the minimal rotation of z") {
  for (const Eigen::Vector3d& r :
       {Eigen::Vector3d(0, 0, 2), Eigen::Vector3d(0.3, -0.2, 1), Eigen::Vector3d(1, 2, -3),
        Eigen::Vector3d(1, 0, 0), Eigen::Vector3d(1e-9, 2e-9, -1)}) {
    const Frame frame = frame_of(Direction(r));
    Eigen::Matrix3d rotation;
    rotation << frame.u, frame.v, frame.w;
    CHECK((rotation.transpose() * rotation - Eigen::Matrix3d::Identity()).norm() < 1e-14);
    CHECK(rotation.determinant() == Approx(1));
    const Eigen::Matrix3d expected =
        Eigen::Quaterniond::FromTwoVectors(Eigen::Vector3d::UnitZ(), r.normalized()).toRotationMatrix();
    CHECK((rotation - expected).norm() < 1e-6);
  }
}

TEST_CASE("the frame of -z is the half turn about x") {
  const Frame frame = frame_of(Direction(0, 0, -5));
  CHECK(frame.u == Eigen::Vector3d(1, 0, 0));
  CHECK(frame.v == Eigen::Vector3d(0, -1, 0));
  CHECK(frame.w == Eigen::Vector3d(0, 0, -1));
}

TEST_CASE("directions are told by their axis, or by a unit vector in few digits") {
  const auto told = [](double x, double y, double z) { return direction_text({x, y, z}); };
  CHECK(told(0, 0, 1) == "along z");
  CHECK(told(0, 0, 7e100) == "along z");
  CHECK(told(-0.1, 0, 0) == "along -x");
  CHECK(told(1e-8, 2, -1e-8) == "along y");
  CHECK(told(0.3, 0, -0.4) == "along (0.6, 0, -0.8)");
  CHECK(told(0.1234, 0, 0.99236) == "along (0.123, 0, 0.992)");
  CHECK(told(1, 1, 1) == "along (0.577, 0.577, 0.577)");
  // Not to be taken for the axis.
  CHECK(told(0.0002, 0, 1) == "along (0.0002, 0, 1)");
  CHECK(told(-3e-6, 0, 1) == "along (-0.000003, 0, 1)");
}
