#include "stackabilization/core/direction.h"

#include <cmath>

#include "stackabilization/core/errors.h"

namespace stackabilization {

Direction::Direction(const Eigen::Vector3d& vector) : vector_(vector) {
  if (!vector.allFinite()) throw UsageError("a direction needs three finite numbers");
  const double squared = vector.squaredNorm();
  if (vector.isZero(0)) throw UsageError("a direction cannot be (0, 0, 0)");
  if (!std::isnormal(squared))
    throw UsageError(
        "a direction needs numbers whose squares neither overflow nor underflow: the largest from about "
        "10^-150 to 10^150");
}

double Direction::length() const {
  return vector_.norm();
}

Eigen::Vector3d Direction::unit() const {
  return vector_ / vector_.norm();
}

Frame frame_of(const Direction& direction) {
  const Eigen::Vector3d w = direction.unit();
  // Rodrigues' formula for the rotation about z x w, with 1 / (1 + w.z) = (1 - w.z) / (w.x^2 + w.y^2): stable
  // near -z.
  const double lateral = w.x() * w.x() + w.y() * w.y();
  if (lateral == 0) {
    const double side = w.z() > 0 ? 1 : -1;
    return {Eigen::Vector3d::UnitX(), side * Eigen::Vector3d::UnitY(), w};
  }
  const double k = w.z() > 0 ? 1 / (1 + w.z()) : (1 - w.z()) / lateral;
  return {{1 - k * w.x() * w.x(), -k * w.x() * w.y(), -w.x()},
          {-k * w.x() * w.y(), 1 - k * w.y() * w.y(), -w.y()},
          w};
}

}  // namespace stackabilization
