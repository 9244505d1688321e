#pragma once

#include <Eigen/Geometry>
#include <cmath>
#include <cstdint>
#include <numbers>
#include <random>

#include "stackabilization/core/shape.h"

namespace point_sets {

using stackabilization::Points;

/// Reproducible numbers; the distributions of std differ between standard libraries.
class Random {
 public:
  explicit Random(std::uint32_t seed) : engine_(seed) {}
  double uniform(double low, double high) { return low + (high - low) * (engine_() / 4294967296.0); }
  Eigen::Vector3d vector(double reach) {
    const double x = uniform(-reach, reach), y = uniform(-reach, reach), z = uniform(-reach, reach);
    return {x, y, z};
  }
  Eigen::Vector3d unit() {
    for (;;) {
      const Eigen::Vector3d v = vector(1);
      if (v.squaredNorm() < 1 && v.squaredNorm() > 0.01) return v.normalized();
    }
  }
  Eigen::Matrix3d rotation() {
    return Eigen::AngleAxisd(uniform(-std::numbers::pi, std::numbers::pi), unit()).toRotationMatrix();
  }

 private:
  std::mt19937 engine_;
};

inline Points moved(const Points& points, const Eigen::Matrix3d& linear, const Eigen::Vector3d& shift) {
  return (points * linear.transpose()).rowwise() + shift.transpose();
}

inline Points box(const Eigen::Vector3d& size) {
  Points points(8, 3);
  for (int i = 0; i < 8; ++i)
    points.row(i) << (i & 1) * size.x(), (i >> 1 & 1) * size.y(), (i >> 2 & 1) * size.z();
  return points;
}

/// Regular n-gons of two radii at z = 0 and z = height.
inline Points frustum(int n, double bottom, double top, double height) {
  Points points(2 * n, 3);
  for (int i = 0; i < n; ++i) {
    const double angle = 2 * std::numbers::pi * i / n;
    points.row(2 * i) << bottom * std::cos(angle), bottom * std::sin(angle), 0;
    points.row(2 * i + 1) << top * std::cos(angle), top * std::sin(angle), height;
  }
  return points;
}

/// Edge length sqrt(8), inscribed in the cube of side 2.
inline Points tetrahedron() {
  Points points(4, 3);
  points << 1, 1, 1, 1, -1, -1, -1, 1, -1, -1, -1, 1;
  return points;
}

inline Points in_ball(int n, std::uint32_t seed) {
  Random random(seed);
  Points points(n, 3);
  for (int i = 0; i < n; ++i) points.row(i) = (random.unit() * std::cbrt(random.uniform(0, 1))).transpose();
  return points;
}

inline Points on_sphere(int n, std::uint32_t seed) {
  Random random(seed);
  Points points(n, 3);
  for (int i = 0; i < n; ++i) points.row(i) = random.unit().transpose();
  return points;
}

}  // namespace point_sets
