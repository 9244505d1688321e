#include <algorithm>
#include <cmath>
#include <limits>
#include <random>
#include <set>
#include <utility>

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

namespace {

SeparationGradients gradients_of(const Shape& shape, const Vector3d& r, const GradientOptions& options = {}) {
  const SeparationTree tree(shape);
  const Direction direction(r);
  const Separation found = separation(tree, tree, direction, {options.semantics, std::nullopt});
  return separation_gradients({tree, tree, direction, found}, options);
}

/// A change of the vertices of a shape and of the direction.
struct Change {
  Points vertices;
  Vector3d direction;
};

Change random_change(const Shape& shape, std::mt19937& random) {
  std::uniform_real_distribution<double> uniform(-1, 1);
  const auto number = [&] { return uniform(random); };
  return {Points::NullaryExpr(shape.vertices.rows(), 3, number), Vector3d::NullaryExpr(number)};
}

/// What a touch of a shape with itself says of the change of f_max.
double product(const SeparationTouch& touch, const Shape& shape, const Change& change) {
  double sum = touch.direction.dot(change.direction);
  for (int i = 0; i < 3; ++i) {
    const Vector3d upper = change.vertices.row(shape.triangles(touch.upper_triangle, i)).transpose(),
                   lower = change.vertices.row(shape.triangles(touch.lower_triangle, i)).transpose();
    sum += touch.normal.dot(touch.upper_weights[i] * upper - touch.lower_weights[i] * lower);
  }
  return sum;
}

double largest_product(const SeparationGradients& gradients, const Shape& shape, const Change& change) {
  double largest = -std::numeric_limits<double>::infinity();
  for (const SeparationTouch& touch : gradients.touches)
    largest = std::max(largest, product(touch, shape, change));
  return largest;
}

/// The one-sided quotient of differences of f_max.
double quotient(const Shape& shape, const Vector3d& r, const Change& change) {
  constexpr double step = 1e-7;
  Shape moved = shape;
  moved.vertices += step * change.vertices;
  const double after = minimal_stacking_translation(moved, Direction(r + step * change.direction)).length;
  return (after - minimal_stacking_translation(shape, Direction(r)).length) / step;
}

}  // namespace

TEST_CASE("a box touches itself at all corners of its top, each with the level plane") {
  const Shape box = solids::box({2, 3, 1});
  const SeparationGradients found = gradients_of(box, {0, 0, 1});
  CHECK(found.complete);
  CHECK(found.one_plane_each);
  std::set<std::pair<double, double>> corners;
  for (const SeparationTouch& touch : found.touches) {
    CHECK(touch.normal.isApprox(Vector3d::UnitZ()));
    CHECK(touch.direction.isZero(1e-12));
    CHECK(touch.upper_weights.sum() == Approx(1));
    CHECK(touch.lower_weights.sum() == Approx(1));
    Vector3d upper = Vector3d::Zero(), lower = Vector3d::Zero();
    for (int i = 0; i < 3; ++i) {
      upper += touch.upper_weights[i] * box.corner(touch.upper_triangle, i);
      lower += touch.lower_weights[i] * box.corner(touch.lower_triangle, i);
    }
    CHECK(upper.z() == Approx(1));
    CHECK((upper - lower).isApprox(Vector3d::UnitZ()));
    corners.insert({std::round(upper.x()), std::round(upper.y())});
  }
  CHECK(corners == std::set<std::pair<double, double>>{{0, 0}, {0, 3}, {2, 0}, {2, 3}});
}

TEST_CASE("f_max rises by the largest product with a touch, whatever moves") {
  std::mt19937 random(9);
  for (const Shape& shape : {solids::box({2, 3, 1}), solids::prism(solids::regular_polygon(6), 0.75)})
    for (const Vector3d& r : {Vector3d(0, 0, 1), Vector3d(0.3, -0.2, 2)}) {
      const SeparationGradients found = gradients_of(shape, r);
      REQUIRE(found.complete);
      REQUIRE(found.one_plane_each);
      CHECK(found.touches.size() >= 4);
      int kinks = 0;
      for (int k = 0; k < 100; ++k) {
        const Change change = random_change(shape, random);
        const double largest = largest_product(found, shape, change);
        CHECK(quotient(shape, r, change) == Approx(largest).margin(1e-5));
        kinks += largest > product(found.touches.front(), shape, change) + 1e-3 ? 1 : 0;
      }
      CHECK(kinks > 20);  // with one touch alone most would be wrong
    }
}

TEST_CASE("f_max rises by no more than the largest product where touches have many planes") {
  std::mt19937 random(10);
  const Shape cup = solids::frustum_shell({.segments = 4});  // coordinates without rounding
  for (const auto& [shape, r] :
       {std::pair(cup, Vector3d(0, 0, 1)), {solids::box({1, 1, 1}), Vector3d(1, 1, 1)}}) {
    const SeparationGradients found = gradients_of(shape, r, {.limit = 4096});
    CHECK(found.complete);
    CHECK_FALSE(found.one_plane_each);
    for (int k = 0; k < 50; ++k) {
      const Change change = random_change(shape, random);
      CHECK(quotient(shape, r, change) <= largest_product(found, shape, change) + 1e-2);
    }
  }
}

TEST_CASE("a box along its diagonal has the gradients of all three sides") {
  // f_max is the least of s_i |r| / r_i.
  const Vector3d r(1, 2, 3), size(1, 2, 3);
  const SeparationGradients found = gradients_of(solids::box(size), r);
  for (int i = 0; i < 3; ++i) {
    const Vector3d expected = r.normalized() - r.norm() / r[i] * Vector3d::Unit(i);
    CHECK(std::any_of(found.touches.begin(), found.touches.end(), [&](const SeparationTouch& touch) {
      return touch.direction.isApprox(expected, 1e-9);
    }));
  }
}

TEST_CASE("where one pair of triangles attains a separation, its touch is the gradient") {
  std::mt19937 random(4);
  std::uniform_real_distribution<double> uniform(-1, 1);
  const auto number = [&] { return uniform(random); };
  int alike = 0;
  for (int k = 0; k < 200; ++k) {
    const Matrix3d below = Matrix3d::NullaryExpr(number), above = Matrix3d::NullaryExpr(number);
    const Direction r(number(), number(), 2);
    // Far away, where the trees are not in the axes of the file.
    const Vector3d away(1000, -2000, 500);
    const Shape a = triangle(below.rowwise() + away.transpose()),
                b = triangle(above.rowwise() + away.transpose());
    const SeparationTree tree_a(a), tree_b(b);
    const Separation found = separation(tree_a, tree_b, r);
    if (!found.blocked) continue;
    const SeparationGradients all = separation_gradients({tree_a, tree_b, r, found});
    const SeparationGradient one = separation_gradient(a, b, r, found);
    REQUIRE(all.touches.size() == 1);
    const SeparationTouch& touch = all.touches.front();
    const double size = 1 + one.upper.norm() + one.lower.norm();
    CHECK((touch.upper_weights * touch.normal.transpose() - one.upper).norm() < 1e-9 * size);
    CHECK((touch.lower_weights * touch.normal.transpose() + one.lower).norm() < 1e-9 * size);
    CHECK((touch.direction - one.direction).norm() < 1e-9 * size);
    ++alike;
  }
  CHECK(alike > 40);
}

TEST_CASE("no more touches are found than the limit, and this is said") {
  const Shape box = solids::box({2, 3, 1}), sheet = solids::bumpy_bowl(12);
  const std::size_t all = gradients_of(box, {0, 0, 1}).touches.size();
  for (std::size_t limit = 1; limit <= all + 1; ++limit) {
    const SeparationGradients found =
        gradients_of(box, {0, 0, 1}, {.limit = static_cast<std::int64_t>(limit)});
    CHECK(found.touches.size() == std::min(limit, all));
    CHECK(found.complete == (limit >= all));
  }
  // Every triangle touches its copy.
  const SeparationGradients of_sheet = gradients_of(sheet, {0, 0, 1}, {.limit = 50});
  CHECK(of_sheet.touches.size() <= 50);
  CHECK_FALSE(of_sheet.touches.empty());
  CHECK_FALSE(of_sheet.complete);
  CHECK_THROWS_AS(gradients_of(box, {0, 0, 1}, {.limit = 0}), UsageError);
}

TEST_CASE("a triangle without area that touches is left out, and this is said") {
  const Shape line = triangle((Matrix3d() << 0, 0, 2, 1, 1, 2, 2, 2, 2).finished());
  const SeparationGradients found = gradients_of(line, {0, 0, 1}, {.semantics = ContactSemantics::closed});
  CHECK(found.touches.empty());
  CHECK_FALSE(found.complete);
  const Shape here = triangle((Matrix3d() << 0, 0, 0, 1, 0, 0, 0, 1, 0).finished());
  CHECK_THROWS_AS(gradients_of(here, {1, 0, 0}), UsageError);
}
