#pragma once

#include <array>
#include <cmath>
#include <vector>

#include "stackabilization/shape/shape.h"

// Small analytic solids with known envelopes.
namespace solids {

using stackabilization::Points;
using stackabilization::Shape;
using stackabilization::Triangles;

/// Surface of revolution about z of a closed polygon of (radius, height) rows, in `sides` flat facets.
inline Shape revolved(const std::vector<std::array<double, 2>>& profile, int sides) {
  const int n = static_cast<int>(profile.size());
  Points points(n * sides, 3);
  Triangles triangles(2 * n * sides, 3);
  for (int s = 0; s < sides; ++s)
    for (int k = 0; k < n; ++k) {
      const double angle = 2 * 3.14159265358979323846 * s / sides;
      const auto [radius, height] = profile[static_cast<std::size_t>(k)];
      points.row(s * n + k) << radius * std::cos(angle), radius * std::sin(angle), height;
      const int s1 = (s + 1) % sides, k1 = (k + 1) % n;
      triangles.row(2 * (s * n + k)) << s * n + k, s1 * n + k, s1 * n + k1;
      triangles.row(2 * (s * n + k) + 1) << s * n + k, s1 * n + k1, s * n + k1;
    }
  return stackabilization::make_shape(points, triangles);
}

/// Conical shell without bottom: outer radius 1 at the foot and `rim` at height `height`, `wall` thick horizontally.
inline Shape frustum_shell(double rim, double height, double wall, int sides) {
  return revolved({{1, 0}, {rim, height}, {rim - wall, height}, {1 - wall, 0}}, sides);
}

/// Box [0, x] x [0, y] x [0, z] whose top is lifted by slope * x: a prism with a slanted top.
inline Shape slanted_prism(const Eigen::Vector3d& size, double slope) {
  Points points(8, 3);
  for (int i = 0; i < 8; ++i) {
    const double x = (i & 1) != 0 ? size.x() : 0;
    points.row(i) << x, (i & 2) != 0 ? size.y() : 0, (i & 4) != 0 ? size.z() + slope * x : 0;
  }
  Triangles triangles(12, 3);
  triangles << 0, 2, 1, 1, 2, 3, 4, 5, 6, 5, 7, 6, 0, 1, 4, 1, 5, 4, 2, 6, 3, 3, 6, 7, 0, 4, 2, 2, 4, 6, 1, 3, 5, 3, 7,
      5;
  return stackabilization::make_shape(points, triangles);
}

}  // namespace solids
