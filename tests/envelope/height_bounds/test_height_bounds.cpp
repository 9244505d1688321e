#include <array>
#include <cmath>
#include <limits>
#include <random>

#include "envelope/height_bounds/height_bounds.h"
#include "mesh/welded_mesh.h"
#include "stackabilization/core/rational.h"
#include "stackabilization/envelope/height_field.h"
#include "support/catch.h"
#include "support/solids.h"

using namespace stackabilization;
using namespace stackabilization::detail;

namespace {

constexpr double nothing = std::numeric_limits<double>::infinity();

/// Bounds along z.
struct Bounded {
  WeldedMesh mesh;
  EdgeTable edges;
  HeightBounds bounds;

  explicit Bounded(const Shape& shape, double error = 1e-15)
      : mesh(weld(shape)), edges(mesh.triangles), bounds({mesh.points, &mesh.triangles, &edges, error}) {}
};

/// The height of the plane through three points over (x, y), exact.
Rational plane_height(const std::array<Eigen::Vector3d, 3>& corners, double x, double y) {
  const auto difference = [](double a, double b) { return Rational(a) - Rational(b); };
  const Eigen::Vector3d& p = corners[0];
  const Rational ax = difference(corners[1].x(), p.x()), ay = difference(corners[1].y(), p.y()),
                 ah = difference(corners[1].z(), p.z()), bx = difference(corners[2].x(), p.x()),
                 by = difference(corners[2].y(), p.y()), bh = difference(corners[2].z(), p.z());
  const Rational dx = difference(x, p.x()), dy = difference(y, p.y()), area = ax * by - ay * bx;
  return Rational(p.z()) + ((dx * by - dy * bx) * ah + (ax * dy - ay * dx) * bh) / area;
}

}  // namespace

TEST_CASE("a flat top bounds its height from both sides, also across its triangles") {
  Bounded box(solids::box({0, 0, 0}, {2, 2, 1}));
  for (const PlanarBox& inside : {PlanarBox{0.25, 1.75, 0.25, 1.75}, PlanarBox{0.7, 0.7, 0.6, 0.6}}) {
    CHECK(box.bounds.over(inside).low == Approx(1).margin(1e-12));
    CHECK(box.bounds.over(inside).high == Approx(1).margin(1e-12));
  }
  // Beyond the border nothing is below; beside it there is nothing at all.
  CHECK(box.bounds.over({1, 2.25, 1, 1.5}).low == -nothing);
  CHECK(box.bounds.over({1, 2.25, 1, 1.5}).high == Approx(1).margin(1e-12));
  CHECK(box.bounds.over({1, 2.25, 1, 1.5}).covered_low >= 0);
  CHECK(box.bounds.over({3, 4, 0, 1}).covered_low == nothing);
  CHECK(box.bounds.over({3, 4, 0, 1}).high == -nothing);
}

TEST_CASE(
    "at a border the lowest covered point is that of the top of a solid, and of any sheet of an open "
    "surface") {
  // A solid one 1 high, and beside it, not touching, one 3 high.
  Bounded solids_beside(concatenate(solids::box({0, 0, 0}, {1, 1, 1}), solids::box({1.25, 0, 0}, {2, 1, 3})));
  CHECK(solids_beside.bounds.over({0.75, 1.125, 0.25, 0.75}).covered_low == Approx(1).margin(1e-12));
  CHECK(solids_beside.bounds.over({1.125, 1.5, 0.25, 0.75}).covered_low == Approx(3).margin(1e-12));
  CHECK(solids_beside.bounds.over({0.75, 1.5, 0.25, 0.75}).covered_low == Approx(1).margin(1e-12));
  // A sheet at 1 that faces up, and one at 0, further right, that faces down.
  Points points(8, 3);
  points << 0, 0, 1, 1, 0, 1, 1, 1, 1, 0, 1, 1, 0.9, 0, 0, 2, 0, 0, 2, 1, 0, 0.9, 1, 0;
  Triangles rows(4, 3);
  rows << 0, 1, 2, 0, 2, 3, 4, 6, 5, 4, 7, 6;
  Bounded sheets(make_shape(points, rows));
  CHECK(sheets.bounds.over({0.5, 1.5, 0.25, 0.75}).covered_low == Approx(0).margin(1e-12));
  CHECK(sheets.bounds.over({-0.5, 0.5, 0.25, 0.75}).covered_low == Approx(1).margin(1e-12));
}

TEST_CASE("the area of a projection is within its bounds, which more rectangles narrow") {
  Bounded ring(solids::torus({}));
  const Range rough = ring.bounds.covered_area(64), fine = ring.bounds.covered_area(4096);
  CHECK(rough.low <= fine.low);
  CHECK(fine.high <= rough.high);
  Bounded bar(solids::extruded_profile({{-1, 0}, {1, 0}, {0, 1}}, 2));
  const Range exact = bar.bounds.covered_area(4096);
  CHECK(exact.low <= 4);
  CHECK(exact.high >= 4);
  CHECK(exact.length() < 0.1);
}

TEST_CASE("along the slope of a surface the bounds do not depend on the size of the rectangle") {
  // A ridge: u = 1 - |x| over [-1, 1].
  Bounded ridge(solids::extruded_profile({{-1, 0}, {1, 0}, {0, 1}}, 2));
  const HeightBound side = ridge.bounds.over({0.25, 0.75, 0.5, 1.5}, {-1, 0});
  CHECK(side.low == Approx(1).margin(1e-12));
  CHECK(side.high == Approx(1).margin(1e-12));
  CHECK(ridge.bounds.slope_at(0.5, 1).isApprox(Eigen::Vector2d(-1, 0)));
  const HeightBound level = ridge.bounds.over({0.25, 0.75, 0.5, 1.5});
  CHECK(level.low == Approx(0.25).margin(1e-12));
  CHECK(level.high == Approx(0.75).margin(1e-12));
}

TEST_CASE("bounds over a point hold the exact height of a triangle there") {
  std::mt19937 random(17);
  std::uniform_real_distribution<double> unit(-1, 1);
  Triangles rows(1, 3);
  rows << 0, 1, 2;
  int covered = 0;
  for (int k = 0; k < 3000; ++k) {
    std::array<Eigen::Vector3d, 3> corners;
    Points points(3, 3);
    for (int c = 0; c < 3; ++c) {
      // Every other triangle is high up, where heights have fewer digits than differences of heights.
      const double x = unit(random), y = unit(random), z = unit(random) + (k % 2 == 0 ? 0 : 1000);
      corners[static_cast<std::size_t>(c)] = {x, y, z};
      points.row(c) << x, y, z;
    }
    // Coordinates as they are: what is left are the roundings of the bounds themselves.
    Bounded bounded(make_shape(points, rows), 0);
    const Eigen::Vector3d middle = (corners[0] + corners[1] + corners[2]) / 3;
    const HeightBound bound = bounded.bounds.over({middle.x(), middle.x(), middle.y(), middle.y()});
    if (bound.low == -nothing) continue;
    ++covered;
    const Rational exact = plane_height(corners, middle.x(), middle.y());
    REQUIRE(Rational(bound.low) <= exact);
    REQUIRE(Rational(bound.high) >= exact);
    // Along the slope of the triangle, where no term has room for the rounding of another one.
    const Eigen::Vector2d slope = bounded.bounds.slope_at(middle.x(), middle.y());
    const HeightBound along = bounded.bounds.over({middle.x(), middle.x(), middle.y(), middle.y()}, slope);
    const Rational rest =
        exact - Rational(slope.x()) * Rational(middle.x()) - Rational(slope.y()) * Rational(middle.y());
    REQUIRE(Rational(along.low) <= rest);
    REQUIRE(Rational(along.high) >= rest);
  }
  CHECK(covered > 2500);
}

TEST_CASE("a hole is seen, however small it is") {
  // A plate with a hole of a thousandth of its width: four bars around it, welded at their corners.
  const double a = 0.4995, b = 0.5005;
  Shape plate = solids::box({0, 0, 0}, {a, 1, 1});
  for (const Shape& bar : {solids::box({b, 0, 0}, {1, 1, 1}), solids::box({a, 0, 0}, {b, a, 1}),
                           solids::box({a, b, 0}, {b, 1, 1})})
    plate = concatenate(plate, bar);
  Bounded bounded(plate);
  CHECK(bounded.bounds.over({0.25, 0.75, 0.25, 0.75}).low == -nothing);
  CHECK(bounded.bounds.over({0.1, 0.3, 0.1, 0.9}).low == Approx(1).margin(1e-12));
}

TEST_CASE("bounds over random rectangles hold for the envelope at random points") {
  std::mt19937 random(7);
  std::uniform_real_distribution<double> unit(0, 1);
  int covered = 0;
  for (const Shape& shape : {solids::sphere(1, 3), solids::torus({}), solids::frustum_shell({}),
                             solids::table({}), solids::stair_plate({})}) {
    Bounded bounded(shape);
    const PlanarBox box = bounded.bounds.box();
    for (int i = 0; i < 200; ++i) {
      const double size = std::pow(unit(random), 3) * box.width();
      const double x = box.x_low + unit(random) * box.width(), y = box.y_low + unit(random) * box.height();
      const PlanarBox part{x, x + size, y, y + size * unit(random)};
      const Eigen::Vector2d slope(unit(random) - 0.5, unit(random) - 0.5);
      const HeightBound level = bounded.bounds.over(part), tilted = bounded.bounds.over(part, slope);
      Window window{part.x_low, part.y_low, std::max(part.width(), 1e-9) / 4, 4, 1};
      const HeightField field = height_field_by_rays(shape, Direction(0, 0, 1), window);
      for (int k = 0; k < 4; ++k) {
        const Eigen::Vector2d p = window.sample(k, 0);
        if (p.y() > part.y_high) continue;
        const double u = field.upper(k, 0);
        CHECK(u >= level.low - 1e-12);
        CHECK(u <= level.high + 1e-12);
        if (field.covered(k, 0)) {
          CHECK(u >= level.covered_low - 1e-12);
          CHECK(u - slope.dot(p) >= tilted.covered_low - 1e-12);
        }
        if (level.low > -nothing) {
          ++covered;
          CHECK(u - slope.dot(p) >= tilted.low - 1e-12);
        }
        CHECK(u - slope.dot(p) <= tilted.high + 1e-12);
      }
    }
  }
  CHECK(covered > 300);  // it does not hold because nothing is claimed
}
