#include <cmath>

#include "stacking/measure/exact_span.h"
#include "support/catch.h"
#include "support/solids.h"
#include "support/variants.h"

using namespace stackabilization;

namespace {

Rational dot(const Eigen::Vector3d& a, const Eigen::Vector3d& b) {
  return Rational(a.x()) * Rational(b.x()) + Rational(a.y()) * Rational(b.y()) +
         Rational(a.z()) * Rational(b.z());
}

/// Largest p . r / r . r with rationals for every vertex.
Rational top_by_brute_force(const Shape& shape, const Eigen::Vector3d& r) {
  Rational top = dot(shape.corner(0, 0), r);
  for (Eigen::Index t = 0; t < shape.triangle_count(); ++t)
    for (int c = 0; c < 3; ++c) top = std::max(top, dot(shape.corner(t, c), r));
  return top / dot(r, r);
}

}  // namespace

TEST_CASE("the span of a box, in units of r") {
  const Span span = exact_span(solids::box({-1, -1, -1}, {1, 2, 3}), Direction(1, 2, 3));
  CHECK(span.top == Rational("14", "14"));
  CHECK(span.bottom == Rational("-6", "14"));
  CHECK(span.approximate_top == 1);
  CHECK(span.approximate_bottom == -6.0 / 14);
  CHECK(exact_span(solids::box({1, 2, 3}), Direction(0, 0, 2)).top == Rational(1.5));
}

TEST_CASE("spans equal rationals over all vertices") {
  for (std::uint64_t seed = 1; seed <= 10; ++seed) {
    const Shape shape = solids::triangle_soup({.seed = seed, .count = 30, .grid_bits = seed % 2 ? 0 : 2});
    for (const Eigen::Vector3d& r :
         {Eigen::Vector3d(0.3, -0.2, 1), Eigen::Vector3d(1, 1, 1), solids::Random(seed).on_sphere()}) {
      const Span span = exact_span(shape, Direction(r));
      CHECK(span.top == top_by_brute_force(shape, r));
      CHECK(span.bottom == Rational() - top_by_brute_force(shape, -r));
      CHECK(span.approximate_top == span.top.to_double());
      CHECK(span.approximate_bottom == span.bottom.to_double());
    }
  }
}

TEST_CASE("heights that doubles cannot tell apart are told apart") {
  const double tiny = std::ldexp(1.0, -70);
  for (const int highest : {0, 1, 2}) {
    Points vertices(3, 3);
    vertices << 1, 0, 0, 0, 1, 0, 0, 0, 1;
    vertices(highest, (highest + 1) % 3) = tiny;
    Triangles triangles(1, 3);
    triangles << 0, 1, 2;
    const Span span = exact_span(make_shape(vertices, triangles), Direction(1, 1, 1));
    CHECK(span.top == (Rational(1.0) + Rational(tiny)) / Rational(3.0));
    CHECK(span.bottom == Rational("1", "3"));
  }
}

TEST_CASE("vertices that no triangle uses have no span") {
  Points vertices(4, 3);
  vertices << 0, 0, 0, 1, 0, 0, 0, 1, 1, 9, 9, 9;
  Triangles triangles(1, 3);
  triangles << 0, 1, 2;
  CHECK(exact_span(make_shape(vertices, triangles), Direction(0, 0, 1)).top == Rational(1.0));
}
