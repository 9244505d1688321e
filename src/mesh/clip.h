#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <vector>

namespace stackabilization::detail {

/// Returns the portion of a convex polygon with value(corner) >= 0, for a function that is linear on it
/// (Sutherland and Hodgman 1974). `between(a, b, t)` returns the point a + t (b - a).
template <class Corner, class Value, class Between>
std::vector<Corner> clipped(const std::vector<Corner>& polygon, const Value& value, const Between& between) {
  std::vector<Corner> kept;
  for (std::size_t c = 0; c < polygon.size(); ++c) {
    const Corner &a = polygon[c], &b = polygon[(c + 1) % polygon.size()];
    const double at_a = value(a), at_b = value(b);
    if (at_a >= 0) kept.push_back(a);
    if ((at_a > 0 && at_b < 0) || (at_a < 0 && at_b > 0)) kept.push_back(between(a, b, at_a / (at_a - at_b)));
  }
  return kept;
}

/// The same for points in space.
template <class Value>
std::vector<Eigen::Vector3d> clipped(const std::vector<Eigen::Vector3d>& polygon, const Value& value) {
  return clipped(polygon, value, [](const Eigen::Vector3d& a, const Eigen::Vector3d& b, double t) {
    return Eigen::Vector3d(a + t * (b - a));
  });
}

}  // namespace stackabilization::detail
