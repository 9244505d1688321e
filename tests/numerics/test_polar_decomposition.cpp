#include <Eigen/Dense>
#include <cmath>

#include "numerics/polar_decomposition.h"
#include "support/catch.h"

namespace stackabilization::polar_decomposition_test {

using detail::polar_decomposition;
using detail::PolarDecomposition;
using Eigen::Matrix3d;
using Eigen::Vector3d;

namespace {

Matrix3d turn(const Vector3d& axis, double radians) {
  return Eigen::AngleAxisd(radians, axis.normalized()).toRotationMatrix();
}

void check_form(const Matrix3d& matrix, const PolarDecomposition& polar) {
  CHECK((polar.rotation * polar.rotation.transpose() - Matrix3d::Identity()).norm() < 1e-14);
  CHECK(std::abs(polar.rotation.determinant() - 1) < 1e-14);
  CHECK((polar.stretch() - polar.stretch().transpose()).norm() < 1e-14 * (1 + matrix.norm()));
  CHECK((polar.rotation * polar.stretch() - matrix).norm() < 1e-14 * (1 + matrix.norm()));
}

}  // namespace

TEST_CASE("a rotation times a stretch comes apart into both") {
  const Matrix3d rotation = turn({1, -2, 0.5}, 2.1), axes = turn({0.3, 1, 1}, 0.7);
  const Vector3d factors(3, 1.5, 0.2);
  const Matrix3d stretch = axes * factors.asDiagonal() * axes.transpose();
  const PolarDecomposition polar = polar_decomposition(rotation * stretch);
  check_form(rotation * stretch, polar);
  CHECK((polar.rotation - rotation).norm() < 1e-14);
  CHECK((polar.stretch() - stretch).norm() < 1e-14);
  CHECK((polar.factors - factors).norm() < 1e-14);
}

TEST_CASE("where a matrix mirrors, the least stretch is negative and the rotation stays one") {
  const Matrix3d matrix = turn({0, 1, 1}, 1.2) * Vector3d(2, -1, 0.5).asDiagonal();
  const PolarDecomposition polar = polar_decomposition(matrix);
  check_form(matrix, polar);
  CHECK((polar.factors - Vector3d(2, 1, -0.5)).norm() < 1e-14);
}

TEST_CASE("no rotation is nearer, also to singular matrices") {
  const Matrix3d flat = turn({1, 0, 2}, 0.4) * Vector3d(1, 0.6, 0).asDiagonal(),
                 straight = turn({1, 5, 2}, 3) * Vector3d(1, 0, 0).asDiagonal(),
                 mirrored = turn({2, 1, 2}, 1) * Vector3d(1, 0.9, -0.3).asDiagonal();
  for (const Matrix3d& matrix : {flat, straight, mirrored, Matrix3d(Matrix3d::Zero())}) {
    const PolarDecomposition polar = polar_decomposition(matrix);
    check_form(matrix, polar);
    const double distance = (polar.rotation - matrix).norm();
    for (const Vector3d& axis : {Vector3d(1, 0, 0), Vector3d(0, 1, 0), Vector3d(0, 0, 1), Vector3d(1, 1, 1)})
      for (const double radians : {-3.0, -1.0, -1e-3, 1e-3, 1.0, 2.0})
        CHECK((polar.rotation * turn(axis, radians) - matrix).norm() >= distance - 1e-14);
  }
}

}  // namespace stackabilization::polar_decomposition_test
