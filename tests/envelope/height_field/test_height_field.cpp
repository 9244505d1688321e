#include <algorithm>
#include <cmath>
#include <functional>
#include <numbers>
#include <vector>

#include "stackabilization/core/errors.h"
#include "stackabilization/envelope/height_field.h"
#include "support/catch.h"
#include "support/directions.h"
#include "support/solids.h"
#include "support/variants.h"

using namespace stackabilization;

namespace {

using Maker = std::function<HeightField(const Shape&, const Direction&, const Window&)>;

struct NamedMaker {
  const char* name;
  Maker make;
};

const std::vector<NamedMaker> makers = {{"rays", height_field_by_rays},
                                        {"scanline", height_field_by_scanline}};
Shape triangle_sheet(const Eigen::Vector3d& a, const Eigen::Vector3d& b, const Eigen::Vector3d& c) {
  Points points(3, 3);
  points << a.transpose(), b.transpose(), c.transpose();
  Triangles triangles(1, 3);
  triangles << 0, 1, 2;
  return make_shape(points, triangles);
}

/// Ring of a surface of revolution over a regular n-gon that q lies on: its circumradius.
double ring_radius(const Eigen::Vector2d& q, int segments) {
  const double step = 2 * std::numbers::pi / segments;
  const double sector = std::remainder(std::atan2(q.y(), q.x()) - step / 2, step);
  return q.norm() * std::cos(sector) / std::cos(step / 2);
}

}  // namespace

TEST_CASE("a box has the same gap at every sample, and the window fits it", "[height_field]") {
  const Shape box = solids::box({-1, 4, 2}, {3, 7, 7});
  const Window window = window_around(box, upwards, 8);
  CHECK(window.columns == 8);
  CHECK(window.rows == 6);
  CHECK(window.pixel_size == 0.5);
  CHECK(window.x == -1);
  CHECK(window.y == 4);
  for (const NamedMaker& maker : makers) {
    CAPTURE(maker.name);
    const HeightField field = maker.make(box, upwards, window);
    CHECK((field.upper.array() == 7).all());
    CHECK((field.lower.array() == 2).all());
    CHECK((gap(field).array() == 5).all());
  }
}

TEST_CASE("heights run along the unit vector whatever the length of the direction", "[height_field]") {
  const Shape box = solids::box({1, 2, 3});
  for (const NamedMaker& maker : makers) {
    CAPTURE(maker.name);
    const Direction along(0, -8, 0);
    const HeightField field = maker.make(box, along, window_around(box, along, 6));
    CHECK(field.frame.w.isApprox(-Eigen::Vector3d::UnitY()));
    CHECK(field.upper.maxCoeff() == 0);
    CHECK(field.lower.minCoeff() == -2);
    CHECK(maximum_gap(field).value == 2);
  }
}

TEST_CASE("the frustum shell's envelopes are its walls, floor and rim", "[height_field]") {
  const solids::FrustumShell cup;
  const Shape shape = solids::frustum_shell(cup);
  const Window window = window_around(shape, upwards, 61);
  for (const NamedMaker& maker : makers) {
    CAPTURE(maker.name);
    const HeightField field = maker.make(shape, upwards, window);
    int covered = 0;
    for (int j = 0; j < window.rows; ++j)
      for (int i = 0; i < window.columns; ++i) {
        const double rho = ring_radius(window.sample(i, j), cup.segments);
        if (std::abs(rho - cup.outer_top) < 1e-9) continue;
        REQUIRE(field.covered(i, j) == (rho < cup.outer_top));
        if (rho > cup.outer_top) continue;
        ++covered;
        const double inner =
            std::clamp((rho - cup.inner_bottom) / (cup.inner_top - cup.inner_bottom), 0.0, 1.0);
        const double outer =
            std::clamp((rho - cup.outer_bottom) / (cup.outer_top - cup.outer_bottom), 0.0, 1.0);
        REQUIRE(field.upper(i, j) == Approx(cup.floor + inner * (cup.height - cup.floor)).margin(1e-10));
        REQUIRE(field.lower(i, j) == Approx(outer * cup.height).margin(1e-10));
      }
    CHECK(covered > 2000);
  }
}

TEST_CASE("a sphere's gap is its chord, from below", "[height_field]") {
  const Shape sphere = solids::sphere(2, 4);
  const Direction oblique(0.3, -0.2, 1);
  const Window window = window_around(sphere, oblique, 40);
  for (const NamedMaker& maker : makers) {
    CAPTURE(maker.name);
    const Eigen::MatrixXd chord = gap(maker.make(sphere, oblique, window));
    for (int j = 0; j < window.rows; ++j)
      for (int i = 0; i < window.columns; ++i) {
        const double squared = window.sample(i, j).squaredNorm();
        if (squared > 3.9) continue;
        REQUIRE(chord(i, j) <= 2 * std::sqrt(4 - squared) + 1e-12);
        REQUIRE(chord(i, j) >= 2 * std::sqrt(3.98 - squared) - 1e-12);
      }
  }
}

TEST_CASE("rays and scan conversion agree at every sample", "[height_field]") {
  const std::vector<Shape> shapes = {solids::frustum_shell({}), solids::torus({}),
                                     solids::stair_plate({}),   solids::hook({}),
                                     solids::wine_glass(24),    solids::gridfinity_bin({})};
  const std::vector<Direction> directions = {{0, 0, 1}, {0.3, -0.2, 1}, {1, 0, 0}, {-0.5, 3, -0.25}};
  for (std::size_t s = 0; s < shapes.size(); ++s)
    for (const Direction& direction : directions) {
      CAPTURE(s, direction.vector().transpose());
      const Window window = window_around(shapes[s], direction, 53);
      const HeightField rays = height_field_by_rays(shapes[s], direction, window);
      const HeightField scan = height_field_by_scanline(shapes[s], direction, window);
      int uncovered_by_one = 0;
      for (int j = 0; j < window.rows; ++j)
        for (int i = 0; i < window.columns; ++i) {
          if (rays.covered(i, j) != scan.covered(i, j)) ++uncovered_by_one;
          if (!rays.covered(i, j) || !scan.covered(i, j)) continue;
          REQUIRE(rays.upper(i, j) == Approx(scan.upper(i, j)).margin(1e-9));
          REQUIRE(rays.lower(i, j) == Approx(scan.lower(i, j)).margin(1e-9));
        }
      // Samples on the outline itself may fall to either side of it by rounding.
      CHECK(uncovered_by_one <= window.rows);
    }
}

TEST_CASE("neighbouring triangles leave no crack between them", "[height_field]") {
  const Shape sphere = solids::sphere(1, 2);
  for (const NamedMaker& maker : makers) {
    CAPTURE(maker.name);
    // Samples k / 32, exactly: also on the vertices and edges over the axes. All of the disc is covered
    // twice.
    const HeightField field = maker.make(sphere, upwards, {-1 - 1.0 / 64, -1 - 1.0 / 64, 1.0 / 32, 65, 65});
    REQUIRE(field.window.sample(32, 32).norm() == 0);
    for (int j = 0; j < 65; ++j)
      for (int i = 0; i < 65; ++i)
        if (field.window.sample(i, j).norm() < 0.9) REQUIRE(field.upper(i, j) - field.lower(i, j) > 0.8);
  }
}

TEST_CASE("vertical triangles count with both ends", "[height_field]") {
  const Window on_the_wall{-0.5, -0.5, 1, 4, 1};  // samples (0, 0), (1, 0), (2, 0), (3, 0)
  const Shape along_row = triangle_sheet({0, 0, 0}, {2, 0, 0}, {2, 0, 6});
  const Shape across_row = triangle_sheet({1, -1, 0}, {1, 1, 0}, {1, 1, 6});
  const Shape single_column = triangle_sheet({2, 0, -1}, {2, 0, 5}, {2, 1, 5});
  for (const NamedMaker& maker : makers) {
    CAPTURE(maker.name);
    const Eigen::MatrixXd along = gap(maker.make(along_row, upwards, on_the_wall));
    CHECK(along(0, 0) == 0);
    CHECK(along(1, 0) == 3);
    CHECK(along(2, 0) == 6);
    CHECK(std::isnan(along(3, 0)));
    const Eigen::MatrixXd across = gap(maker.make(across_row, upwards, on_the_wall));
    CHECK(std::isnan(across(0, 0)));
    CHECK(across(1, 0) == 3);
    CHECK(std::isnan(across(2, 0)));
    CHECK(gap(maker.make(single_column, upwards, on_the_wall))(2, 0) == 6);
  }
}

TEST_CASE("an open sheet has no gap and keeps its slope", "[height_field]") {
  const Shape sheet = triangle_sheet({0, 0, 0}, {4, 0, 4}, {0, 4, 8});
  for (const NamedMaker& maker : makers) {
    CAPTURE(maker.name);
    const HeightField field = maker.make(sheet, upwards, window_around(sheet, upwards, 16));
    CHECK(maximum_gap(field).value == 0);
    CHECK(maximum_gap(field).column == 0);
    const Eigen::Vector2d q = field.window.sample(3, 5);
    CHECK(field.upper(3, 5) == Approx(q.x() + 2 * q.y()));
    CHECK_FALSE(field.covered(15, 15));
  }
}

TEST_CASE("slivers never throw heights out of their own range", "[height_field]") {
  const Shape sliver = triangle_sheet({0, 0, 0}, {1, 1e-17, 1}, {0.5, 0.5e-17, 3});
  const Direction directions[] = {{0, 0, 1}, {1e-9, 1e-17, 1}, {0.1, 0, 1}};
  for (const NamedMaker& maker : makers)
    for (const Direction& direction : directions) {
      CAPTURE(maker.name, direction.vector().transpose());
      const HeightField field = maker.make(sliver, direction, window_around(sliver, direction, 7));
      for (Eigen::Index k = 0; k < field.upper.size(); ++k)
        if (field.upper(k) >= field.lower(k)) {
          REQUIRE(field.upper(k) <= 3.1);
          REQUIRE(field.lower(k) >= -1e-12);
        }
    }
}

TEST_CASE("windows beside the shape and single samples are fine", "[height_field]") {
  const Shape box = solids::box({1, 1, 1});
  for (const NamedMaker& maker : makers) {
    CAPTURE(maker.name);
    const HeightField beside = maker.make(box, upwards, {1e6, -1e9, 3, 5, 4});
    CHECK(maximum_gap(beside).value == 0);
    CHECK(maximum_gap(beside).column == -1);
    CHECK(gap(beside).array().isNaN().all());
    const HeightField single = maker.make(box, upwards, window_around(box, upwards, 1));
    CHECK(single.upper.size() == 1);
    CHECK(maximum_gap(single).value == 1);
    // A window that is larger than the shape on every side, with one sample inside.
    CHECK(maximum_gap(maker.make(box, upwards, {-7, -7, 3, 5, 5})).value == 1);
  }
}

TEST_CASE("windows of flat projections have at least one pixel", "[height_field]") {
  const Shape wall = triangle_sheet({0, 0, 0}, {2, 0, 0}, {2, 0, 6});
  const Window flat = window_around(wall, upwards, 10);
  CHECK(flat.columns == 10);
  CHECK(flat.rows == 1);
  CHECK(flat.sample(0, 0).y() == 0);
  const Shape point = triangle_sheet({2, 1, 3}, {2, 1, 3}, {2, 1, 3});
  const Window single = window_around(point, upwards, 10);
  CHECK(single.columns == 1);
  CHECK(single.pixel_size == 1);
  for (const NamedMaker& maker : makers) CHECK(maximum_gap(maker.make(point, upwards, single)).value == 0);
}

TEST_CASE("a stored ray caster answers as a fresh one", "[height_field]") {
  const Shape torus = solids::torus({});
  const RayCaster caster(torus);
  for (const Direction& direction : {Direction(0, 0, 1), Direction(0.3, 0.2, -1), Direction(1, 5, 0)}) {
    const Window window = window_around(torus, direction, 20);
    const HeightField stored = caster.cast(direction, window);
    const HeightField fresh = height_field_by_rays(torus, direction, window);
    CHECK(stored.upper == fresh.upper);
    CHECK(stored.lower == fresh.lower);
  }
}

TEST_CASE("rays meet parts in one place once, and no more triangles than they may", "[height_field]") {
  const Shape box = solids::box({2, 3, 4});
  Shape many = box;
  for (int k = 1; k < 50; ++k) many = concatenate(many, k % 2 == 0 ? box : solids::flipped(box));
  const Direction oblique(0.1, 0.2, 1);
  const Window window = window_around(box, oblique, 16);
  const HeightField field = RayCaster(box).cast(oblique, window);
  const HeightField of_many = RayCaster(many).cast(oblique, window);
  CHECK(of_many.upper == field.upper);
  CHECK(of_many.lower == field.lower);
  // A ray that enters and leaves through the insides of triangles meets two.
  const Window one{0.9, 1.4, 0.01, 1, 1};
  CHECK(RayCaster(many).cast(upwards, one, 2).upper(0, 0) == 4);
  CHECK_THROWS_AS(RayCaster(many).cast(upwards, one, 1), InputError);
}

TEST_CASE("impossible windows and shapes are refused", "[height_field]") {
  const Shape box = solids::box({1, 1, 1});
  CHECK_THROWS_AS(window_around(box, upwards, 0), UsageError);
  CHECK_THROWS_AS(window_around(box, upwards, max_resolution + 1), UsageError);
  CHECK_THROWS_AS(window_around(Shape{}, upwards, 4), InputError);
  CHECK_THROWS_AS(RayCaster(Shape{}), InputError);
  CHECK_THROWS_AS(height_field_by_scanline(Shape{}, upwards, {0, 0, 1, 1, 1}), InputError);
  for (const NamedMaker& maker : makers) {
    CHECK_THROWS_AS(maker.make(box, upwards, {0, 0, 0, 4, 4}), UsageError);
    CHECK_THROWS_AS(maker.make(box, upwards, {0, 0, -1, 4, 4}), UsageError);
    CHECK_THROWS_AS(maker.make(box, upwards, {std::nan(""), 0, 1, 4, 4}), UsageError);
    CHECK_THROWS_AS(maker.make(box, upwards, {0, 0, 1, 0, 4}), UsageError);
    CHECK_THROWS_AS(maker.make(box, upwards, {0, 0, 1, 4, 1 << 30}), UsageError);
  }
}
