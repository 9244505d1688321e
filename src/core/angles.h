#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <cmath>

namespace stackabilization::detail {

/// Returns the angle between two vectors, radians, in [0, pi]; 0 if one of them is zero. Accurate also near 0
/// and pi.
inline double angle_between(const Eigen::Vector3d& a, const Eigen::Vector3d& b) {
  return std::atan2(a.cross(b).norm(), a.dot(b));
}

/// Returns the angle between two lines through 0, or between two planes with these normals, radians, in
/// [0, pi / 2].
inline double angle_between_lines(const Eigen::Vector3d& a, const Eigen::Vector3d& b) {
  return std::atan2(a.cross(b).norm(), std::abs(a.dot(b)));
}

/// Returns the angle between a line and the surface with this normal, radians, in [0, pi / 2]. Accurate also
/// near both ends.
inline double angle_to_surface(const Eigen::Vector3d& normal, const Eigen::Vector3d& line) {
  return std::atan2(std::abs(normal.dot(line)), normal.cross(line).norm());
}

/// Returns whether two vectors lie on one line through 0, up to an angle with this sine. A zero vector lies
/// on every line.
inline bool on_one_line(const Eigen::Vector3d& a, const Eigen::Vector3d& b, double sine) {
  return a.cross(b).norm() <= sine * a.norm() * b.norm();
}

}  // namespace stackabilization::detail
