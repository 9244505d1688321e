#include <Eigen/Geometry>
#include <Eigen/LU>
#include <algorithm>

#include "improvement/explanation/affine_split.h"
#include "support/catch.h"

using namespace stackabilization::detail;

namespace {

const Eigen::Vector3d up = Eigen::Vector3d::UnitZ();

/// The factors of a split whose parts make the map again.
Eigen::Vector3d factors(const Eigen::Matrix3d& linear) {
  const AffineSplit split = split_affine(linear, up);
  const Eigen::Matrix3d again = split.turn * split.axes * split.factors.asDiagonal() * split.axes.transpose();
  CHECK((again - linear).norm() < 1e-12);
  return split.factors;
}

}  // namespace

TEST_CASE("A rotation and a shear along or across up stretch nothing", "[explanation]") {
  const Eigen::Matrix3d turn = Eigen::AngleAxisd(0.3, Eigen::Vector3d(1, 2, 3).normalized()).matrix();
  Eigen::Matrix3d leaning = Eigen::Matrix3d::Identity(), slanting = leaning;
  leaning(0, 2) = 0.2;
  slanting(2, 1) = -0.3;
  for (const Eigen::Matrix3d& linear : {turn, leaning, slanting})
    CHECK((factors(linear) - Eigen::Vector3d::Ones()).norm() < 1e-12);
}

TEST_CASE("A shear beside a small tilt stretches nothing", "[explanation]") {
  Eigen::Matrix3d leaning = Eigen::Matrix3d::Identity();
  leaning(1, 2) = 0.19;
  leaning(2, 1) = 0.005;
  CHECK((factors(leaning) - Eigen::Vector3d::Ones()).norm() < 1e-12);
}

TEST_CASE("A stretch is found before a rotation and beside a shear", "[explanation]") {
  const Eigen::Vector3d by(0.93, 1.1, 1);
  const Eigen::Matrix3d turn = Eigen::AngleAxisd(0.3, Eigen::Vector3d(1, 2, 3).normalized()).matrix();
  Eigen::Matrix3d leaning = Eigen::Matrix3d::Identity();
  leaning(1, 2) = 0.2;
  for (const Eigen::Matrix3d& first : {turn, leaning}) {
    Eigen::Vector3d found = factors(first * by.asDiagonal());
    std::sort(found.data(), found.data() + 3);
    CHECK((found - Eigen::Vector3d(0.93, 1, 1.1)).norm() < 1e-12);
  }
}

TEST_CASE("A map without inverse has a split", "[explanation]") {
  const Eigen::Matrix3d flat = Eigen::Vector3d(1, 1, 0).asDiagonal();
  CHECK(split_affine(flat, up).factors.minCoeff() == Approx(0).margin(1e-15));
}
