#include "stacking/measure/exact_span.h"

#include <algorithm>
#include <array>
#include <limits>
#include <map>

#include "stackabilization/core/tolerances.h"

namespace stackabilization {

namespace {

Rational exact_dot(const Eigen::Vector3d& a, const Eigen::Vector3d& b) {
  return Rational(a.x()) * Rational(b.x()) + Rational(a.y()) * Rational(b.y()) +
         Rational(a.z()) * Rational(b.z());
}

/// Computes the largest p . r over the used vertices exactly, with rationals only for vertices that doubles
/// do not exclude.
Rational exact_support(const Shape& shape, const Eigen::Vector3d& r) {
  double most = -std::numeric_limits<double>::infinity(), magnitude = 0;
  const auto each_vertex = [&](const auto& visit) {
    for (Eigen::Index t = 0; t < shape.triangle_count(); ++t)
      for (int c = 0; c < 3; ++c) visit(shape.corner(t, c));
  };
  each_vertex([&](const Eigen::Vector3d& p) {
    most = std::max(most, p.dot(r));
    magnitude = std::max(magnitude, p.cwiseAbs().dot(r.cwiseAbs()));
  });
  const double rounding = tolerance::product_rounding * magnitude;
  std::map<std::array<double, 3>, Rational> candidates;  // many triangles share the vertices at the top
  each_vertex([&](const Eigen::Vector3d& p) {
    if (p.dot(r) >= most - rounding) candidates.try_emplace({p.x(), p.y(), p.z()}, exact_dot(p, r));
  });
  return std::max_element(candidates.begin(), candidates.end(),
                          [](const auto& a, const auto& b) { return a.second < b.second; })
      ->second;
}

}  // namespace

Span exact_span(const Shape& shape, const Direction& direction) {
  const Eigen::Vector3d& r = direction.vector();
  const Rational squared = exact_dot(r, r);
  Span span;
  span.top = exact_support(shape, r) / squared;
  span.bottom = Rational() - exact_support(shape, -r) / squared;
  span.approximate_top = span.top.to_double();
  span.approximate_bottom = span.bottom.to_double();
  return span;
}

}  // namespace stackabilization
