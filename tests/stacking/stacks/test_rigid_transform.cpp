#include <limits>

#include "stackabilization/core/errors.h"
#include "stackabilization/stacking/rigid_transform.h"
#include "support/catch.h"

using namespace stackabilization;

TEST_CASE("quarter turns about a coordinate axis are exact") {
  const Line line{Eigen::Vector3d(1, 2, 3), Direction(0, 0, 4)};
  Eigen::Matrix3d quarter;
  quarter << 0, -1, 0, 1, 0, 0, 0, 0, 1;
  for (const double degrees : {90.0, 450.0, -270.0}) {
    const RigidTransform turn = rotation_about(line, degrees);
    CHECK(turn.rotation == quarter);
    CHECK(turn.translation == Eigen::Vector3d(3, 1, 0));
  }
  CHECK(rotation_about(line, 180).rotation == quarter * quarter);
  CHECK(rotation_about(line, 720).rotation == Eigen::Matrix3d::Identity());
}

TEST_CASE("a rotation fixes its line, keeps lengths and turns right-handed") {
  const Line line{Eigen::Vector3d(1, -2, 0.5), Direction(0.3, -0.2, 1)};
  const RigidTransform turn = rotation_about(line, 37);
  CHECK_NOTHROW(validate(turn));
  const Eigen::Vector3d on_line = line.point + 2.5 * line.axis.vector();
  CHECK((turn.rotation * on_line + turn.translation - on_line).norm() < 1e-14);
  CHECK(rotation_about({Eigen::Vector3d::Zero(), Direction(0, 0, 1)}, 30).rotation(1, 0) == Approx(0.5));
}

TEST_CASE("turns add up") {
  const Line line{Eigen::Vector3d(1, -2, 0.5), Direction(0.3, -0.2, 1)};
  const RigidTransform step = rotation_about(line, 36);
  const auto turns = powers(step, 11);
  CHECK((turns[10].rotation - Eigen::Matrix3d::Identity()).norm() < 1e-14);
  CHECK(turns[10].translation.norm() < 1e-14);
  const RigidTransform sum = composed(rotation_about(line, 40), rotation_about(line, 32));
  CHECK((sum.rotation - turns[2].rotation).norm() < 1e-14);
  CHECK((sum.translation - turns[2].translation).norm() < 1e-14);
}

TEST_CASE("angles are reduced to one turn") {
  CHECK(reduced_degrees(-180) == 180);
  CHECK(reduced_degrees(540) == 180);
  CHECK(reduced_degrees(-190) == 170);
  CHECK(reduced_degrees(-360) == 0);
  CHECK_THROWS_AS(reduced_degrees(std::numeric_limits<double>::infinity()), UsageError);
}

TEST_CASE("what is not rigid is refused") {
  RigidTransform transform;
  transform.rotation(0, 0) = -1;
  CHECK_THROWS_AS(validate(transform), UsageError);
  transform.rotation(0, 0) = 1.001;
  CHECK_THROWS_AS(validate(transform), UsageError);
  transform = {};
  transform.translation.x() = std::numeric_limits<double>::quiet_NaN();
  CHECK_THROWS_AS(powers(transform, 3), UsageError);
  CHECK_THROWS_AS(powers({}, 0), UsageError);
}
