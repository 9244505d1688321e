#include "stackabilization/shape/direction.h"

#include <charconv>
#include <cmath>

#include "stackabilization/shape/errors.h"

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

std::string direction_text(const Eigen::Vector3d& direction) {
  constexpr double negligible = 1e-6;
  constexpr int min_digits = 3, max_digits = 7;
  const Eigen::Vector3d unit = direction.normalized();
  Eigen::Index axis = 0;
  unit.cwiseAbs().maxCoeff(&axis);
  const auto off_axis = [axis](Eigen::Vector3d v) {
    v[axis] = 0;
    return v.cwiseAbs().maxCoeff();
  };
  if (off_axis(unit) <= negligible) return std::string("along ") + (unit[axis] < 0 ? "-" : "") + "xyz"[axis];
  Eigen::Vector3d shown;
  for (int digits = min_digits; digits <= max_digits; ++digits) {
    const double scale = std::pow(10, digits);
    shown = (unit * scale).array().round() / scale + 0.0;  // no -0
    if (off_axis(shown) > 0) break;
  }
  std::string text = "along (";
  for (const double component : shown) {
    char buffer[32];
    const auto end = std::to_chars(buffer, buffer + sizeof buffer, component).ptr;
    text.append(text.back() == '(' ? "" : ", ").append(buffer, end);
  }
  return text + ")";
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
