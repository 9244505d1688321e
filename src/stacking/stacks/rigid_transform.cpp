#include "stackabilization/stacking/rigid_transform.h"

#include <Eigen/Geometry>
#include <Eigen/LU>
#include <cmath>
#include <numbers>

#include "stackabilization/core/errors.h"
#include "stackabilization/core/tolerances.h"

namespace stackabilization {

void validate(const RigidTransform& transform) {
  if (!transform.rotation.allFinite() || !transform.translation.allFinite())
    throw UsageError("a rigid transform needs finite numbers");
  const Eigen::Matrix3d gram = transform.rotation.transpose() * transform.rotation;
  if ((gram - Eigen::Matrix3d::Identity()).norm() > tolerance::relative ||
      transform.rotation.determinant() < 0)
    throw UsageError("a copy of a stack can only be moved rigidly: its 3 x 3 matrix must be a rotation");
}

double reduced_degrees(double degrees) {
  if (!std::isfinite(degrees)) throw UsageError("an angle must be a finite number of degrees");
  const double reduced = std::remainder(degrees, 360.0);
  return reduced == -180 ? 180 : reduced;
}

namespace {

struct SineCosine {
  double sine, cosine;
};

/// Exact at multiples of 90 degrees.
SineCosine sine_cosine(double degrees) {
  const double reduced = reduced_degrees(degrees);
  if (reduced == 0) return {0, 1};
  if (reduced == 90) return {1, 0};
  if (reduced == -90) return {-1, 0};
  if (reduced == 180) return {0, -1};
  const double radians = reduced * (std::numbers::pi / 180);
  return {std::sin(radians), std::cos(radians)};
}

}  // namespace

RigidTransform rotation_about(const Line& line, double degrees) {
  const auto [sine, cosine] = sine_cosine(degrees);
  const Eigen::Vector3d k = line.axis.unit();
  Eigen::Matrix3d cross;
  cross << 0, -k.z(), k.y(), k.z(), 0, -k.x(), -k.y(), k.x(), 0;
  RigidTransform result;
  result.rotation = cosine * Eigen::Matrix3d::Identity() + sine * cross + (1 - cosine) * k * k.transpose();
  result.translation = line.point - result.rotation * line.point;
  return result;
}

RigidTransform composed(const RigidTransform& second, const RigidTransform& first) {
  return {second.rotation * first.rotation, second.rotation * first.translation + second.translation};
}

std::vector<RigidTransform> powers(const RigidTransform& transform, int count) {
  validate(transform);
  if (count < 1) throw UsageError("a list of powers needs at least one entry");
  std::vector<RigidTransform> result(static_cast<std::size_t>(count));
  for (std::size_t k = 1; k < result.size(); ++k) result[k] = composed(transform, result[k - 1]);
  return result;
}

Shape transformed(const Shape& shape, const RigidTransform& transform) {
  return transformed(shape, transform.rotation, transform.translation);
}

}  // namespace stackabilization
