#include <random>

#include "stackabilization/core/errors.h"
#include "stackabilization/envelope/separation_gradient.h"
#include "support/catch.h"
#include "support/solids.h"

using namespace stackabilization;
using Eigen::Matrix3d;
using Eigen::Vector3d;

namespace {

/// A triangle with these corners in rows.
Shape triangle(const Matrix3d& corners) {
  Triangles rows(1, 3);
  rows << 0, 1, 2;
  return make_shape(corners, rows);
}

Separation separation_of(const Shape& below, const Shape& above, const Vector3d& r) {
  return separation(SeparationTree(below), SeparationTree(above), Direction(r));
}

double length_of(const Matrix3d& below, const Matrix3d& above, const Vector3d& r) {
  return separation_of(triangle(below), triangle(above), r).length;
}

Matrix3d corners_of(const Shape& shape, int row) {
  Matrix3d corners;
  for (int i = 0; i < 3; ++i) corners.row(i) = shape.corner(row, i).transpose();
  return corners;
}

}  // namespace

TEST_CASE("the gradient of a separation is its quotient of differences") {
  std::mt19937 random(3);
  std::uniform_real_distribution<double> uniform(-1, 1);
  const auto number = [&] { return uniform(random); };
  constexpr double step = 1e-6;
  int tried = 0;
  while (tried < 60) {
    const Matrix3d below = Matrix3d::NullaryExpr(number), above = Matrix3d::NullaryExpr(number);
    const Vector3d r = Vector3d(number(), number(), 2);
    const Shape a = triangle(below), b = triangle(above);
    const Separation found = separation_of(a, b, r);
    if (!found.blocked) continue;
    ++tried;
    const SeparationGradient gradient = separation_gradient(a, b, Direction(r), found);
    // Steep triangles change fast: differences are relative to the largest of them.
    const double size = 1 + gradient.upper.norm() + gradient.lower.norm() + gradient.direction.norm();
    for (int i = 0; i < 3; ++i)
      for (int k = 0; k < 3; ++k) {
        Matrix3d move = Matrix3d::Zero();
        move(i, k) = step;
        CHECK((length_of(below + move, above, r) - length_of(below - move, above, r)) / (2 * step) ==
              Approx(gradient.upper(i, k)).margin(1e-4 * size * size));
        CHECK((length_of(below, above + move, r) - length_of(below, above - move, r)) / (2 * step) ==
              Approx(gradient.lower(i, k)).margin(1e-4 * size * size));
      }
    for (int k = 0; k < 3; ++k) {
      const Vector3d turn = step * Vector3d::Unit(k);
      CHECK((length_of(below, above, r + turn) - length_of(below, above, r - turn)) / (2 * step) ==
            Approx(gradient.direction[k]).margin(1e-4 * size * size));
    }
  }
}

TEST_CASE("the gradient of f_max has the invariances of f_max, on solids with kinks too") {
  for (const Shape& shape : {solids::frustum_shell({.segments = 12}), solids::box({1, 2, 3}),
                             solids::stairs({}), solids::sphere(1, 3)})
    for (const Vector3d& r : {Vector3d(0, 0, 1), Vector3d(0.3, -0.2, 2)}) {
      const Separation found = minimal_stacking_translation(shape, Direction(r));
      REQUIRE(found.blocked);
      const SeparationGradient gradient = separation_gradient(shape, shape, Direction(r), found);
      // The copy below one unit higher: one unit more. Across nothing is the matter with it: both move alike.
      CHECK(gradient.upper.colwise().sum().dot(r.normalized()) == Approx(1));
      CHECK((gradient.upper.colwise().sum() + gradient.lower.colwise().sum()).norm() < 1e-9);
      // Twice as large: twice as far. A longer direction is the same direction.
      const double scaled =
          gradient.upper.cwiseProduct(corners_of(shape, found.witness.upper_triangle)).sum() +
          gradient.lower.cwiseProduct(corners_of(shape, found.witness.lower_triangle)).sum();
      CHECK(scaled == Approx(found.length));
      CHECK(gradient.direction.dot(r) == Approx(0).margin(1e-9));
    }
}

TEST_CASE("there is no gradient where shapes pass each other or a triangle has no area") {
  const Shape here = triangle((Matrix3d() << 0, 0, 0, 1, 0, 0, 0, 1, 0).finished());
  const Shape there = triangle((Matrix3d() << 5, 0, 0, 6, 0, 0, 5, 1, 0).finished());
  const Vector3d up(0, 0, 1);
  CHECK_THROWS_AS(separation_gradient(here, there, Direction(up), separation_of(here, there, up)),
                  UsageError);
  const Shape line = triangle((Matrix3d() << 0, 0, 2, 1, 1, 2, 2, 2, 2).finished());
  SeparationOptions closed;
  closed.semantics = ContactSemantics::closed;
  const Separation found = separation(SeparationTree(here), SeparationTree(line), Direction(up), closed);
  REQUIRE(found.blocked);
  CHECK_THROWS_AS(separation_gradient(here, line, Direction(up), found), UsageError);
}
