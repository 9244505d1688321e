#include <Eigen/Geometry>
#include <cmath>

#include "stackabilization/core/errors.h"
#include "stackabilization/improvement/shape_change.h"
#include "support/catch.h"
#include "support/solids.h"

using namespace stackabilization;

namespace {

Shape placed(const Shape& shape, const Eigen::Matrix3d& linear) {
  return transformed(shape, linear, Eigen::Vector3d(3, -7, 0.5));
}

Eigen::Matrix3d oblique_turn() {
  return Eigen::AngleAxisd(2.1, Eigen::Vector3d(1, -2, 0.5).normalized()).toRotationMatrix();
}

Shape chiral() {
  return solids::tetrahedron({Eigen::Vector3d(0, 0, 0), {3, 0, 0}, {0, 2, 0}, {0, 0, 1}});
}

}  // namespace

TEST_CASE("Moved, turned and scaled shapes are unchanged", "[shape_change]") {
  for (const Shape& shape : {solids::table({}), solids::frustum_shell({}), chiral()})
    for (const double factor : {0.01, 1.0, 250.0}) {
      const ShapeChange change = shape_change(shape, placed(shape, factor * oblique_turn()));
      CHECK(change.root_mean_square == Approx(0).margin(1e-13));
      CHECK(change.largest == Approx(0).margin(1e-13));
    }
}

TEST_CASE("A square that becomes a rectangle, in closed form", "[shape_change]") {
  // Centred corners (+-1, +-1) become (+-a, +-1). The best factor is c = (a + 1) / (a^2 + 1); what is left
  // of each corner is (c a - 1, c - 1).
  Points square(4, 3);
  square << -1, -1, 0, 1, -1, 0, 1, 1, 0, -1, 1, 0;
  Triangles triangles(2, 3);
  triangles << 0, 1, 2, 0, 2, 3;
  const Shape before = make_shape(square, triangles);
  const double a = 1.5, c = (a + 1) / (a * a + 1);
  const Shape after = placed(before, oblique_turn() * Eigen::Vector3d(a, 1, 1).asDiagonal());
  const double left = std::hypot(c * a - 1, c - 1) / std::sqrt(8.0);
  const ShapeChange change = shape_change(before, after);
  CHECK(change.root_mean_square == Approx(left));
  CHECK(change.largest == Approx(left));
}

TEST_CASE("One corner of a long bar moved: the farthest vertex is found", "[shape_change]") {
  const Shape before = solids::box({100, 100, 100});
  Shape after = before;
  after.vertices(0, 0) += 1e-3;
  const ShapeChange change = shape_change(before, after);
  // The fit hardly follows one of eight corners: 7/8 of the move and less stays with it.
  CHECK(change.largest * 100 * std::sqrt(3.0) < 1e-3);
  CHECK(change.largest * 100 * std::sqrt(3.0) > 0.5e-3);
  CHECK(change.root_mean_square < change.largest / 2);
}

TEST_CASE("A mirror image is a change", "[shape_change]") {
  const Shape shape = chiral();
  const Shape mirrored = placed(shape, Eigen::Vector3d(-1, 1, 1).asDiagonal());
  CHECK(shape_change(shape, mirrored).root_mean_square > 0.05);
  // That of a flat shape is not: a half turn takes it there.
  Points flat(3, 3);
  flat << 0, 0, 0, 4, 0, 0, 1, 2, 0;
  const Shape triangle = make_shape(flat, (Triangles(1, 3) << 0, 1, 2).finished());
  CHECK(shape_change(triangle, placed(triangle, Eigen::Vector3d(-1, 1, 1).asDiagonal())).root_mean_square ==
        Approx(0).margin(1e-14));
}

TEST_CASE("Vertices that no triangle uses do not count", "[shape_change]") {
  Shape before = chiral();
  before.vertices.conservativeResize(5, 3);
  before.vertices.row(4) << 1, 1, 1;
  Shape after = before;
  after.vertices.row(4) << 1e6, 0, 0;
  CHECK(shape_change(before, after).root_mean_square == Approx(0).margin(1e-14));
}

TEST_CASE("Degenerate shapes have finite changes", "[shape_change]") {
  const Shape solid = chiral();
  Shape point = solid, line = solid;
  point.vertices.setConstant(2);
  line.vertices.rightCols(2).setZero();
  CHECK(shape_change(point, solid).root_mean_square == 0);
  CHECK(shape_change(point, point).root_mean_square == 0);
  // The best fit of a single point is the mean: what is left is the spread of the vertices.
  const Points centred = solid.vertices.rowwise() - solid.vertices.colwise().mean();
  CHECK(shape_change(solid, point).root_mean_square ==
        Approx(std::sqrt(centred.squaredNorm() / 4) / std::sqrt(14.0)));
  CHECK(shape_change(line, placed(line, oblique_turn())).root_mean_square == Approx(0).margin(1e-14));
  CHECK(std::isfinite(shape_change(line, solid).root_mean_square));
  CHECK(std::isfinite(shape_change(solid, line).largest));
}

TEST_CASE("Only shapes with the same vertices and triangles are compared", "[shape_change]") {
  const Shape a = solids::box({1, 1, 1}), b = solids::table({});
  CHECK_THROWS_AS(shape_change(a, b), UsageError);
  Shape c = a;
  c.triangles.row(0).swap(c.triangles.row(1));
  CHECK_THROWS_AS(shape_change(a, c), UsageError);
}
