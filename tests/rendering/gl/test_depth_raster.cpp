#include <Eigen/Geometry>
#include <cmath>
#include <cstdlib>
#include <limits>

#include "stackabilization/core/errors.h"
#include "stackabilization/rendering/depth_raster.h"
#include "support/catch.h"
#include "support/solids.h"

using namespace stackabilization;

namespace {

constexpr double depth_step = 8.0 / 7 / 16777216;  // of the extent, as documented

/// [0, x] x [0, y] x [0, z], its top lifted by slope * x.
Shape slanted_prism(const Eigen::Vector3d& size, double slope) {
  return solids::extruded_profile(
      {{0, 0}, {size.x(), 0}, {size.x(), size.z() + slope * size.x()}, {0, size.z()}}, size.y());
}

int covered_samples(const HeightField& field) {
  int count = 0;
  for (int i = 0; i < field.window.columns; ++i)
    for (int j = 0; j < field.window.rows; ++j) count += field.covered(i, j) ? 1 : 0;
  return count;
}

}  // namespace

TEST_CASE("the depth buffer gives the heights of a box to 24 bits and covers the pixel centres inside") {
  const Shape box = slanted_prism({3, 2, 5}, 0);
  const Window window{-0.5, -0.5, 0.25, 16, 12};
  const HeightField field = height_field_by_depth_buffer(box, Direction(0, 0, 7), window);
  REQUIRE(field.upper.rows() == 16);
  REQUIRE(field.upper.cols() == 12);
  for (int i = 0; i < 16; ++i)
    for (int j = 0; j < 12; ++j) {
      const double x = window.x + (i + 0.5) * window.pixel_size, y = window.y + (j + 0.5) * window.pixel_size;
      const bool inside = 0 < x && x < 3 && 0 < y && y < 2;
      REQUIRE(field.covered(i, j) == inside);
      if (inside) {
        CHECK(std::abs(field.upper(i, j) - 5) <= 5 * depth_step);
        CHECK(std::abs(field.lower(i, j)) <= 5 * depth_step);
      } else {
        CHECK(field.upper(i, j) == -std::numeric_limits<double>::infinity());
        CHECK(field.lower(i, j) == std::numeric_limits<double>::infinity());
      }
    }
}

TEST_CASE("the depth buffer interpolates a slanted top, in a turned and shifted pose too") {
  const Shape prism = slanted_prism({4, 3, 1}, 0.5);
  Eigen::Matrix3d rotation =
      Eigen::AngleAxisd(0.7, Eigen::Vector3d(1, 2, -1).normalized()).toRotationMatrix();
  const Eigen::Vector3d shift(100, -50, 20);
  const Shape turned = transformed(prism, rotation, shift);
  const Direction up(Eigen::Vector3d(rotation.col(2)));
  const Frame frame = frame_of(up);
  const Eigen::Vector3d corner = frame.to_local(shift);
  const Window window{corner.x() - 5, corner.y() - 5, 0.01, 1000, 1000};
  const HeightField field = height_field_by_depth_buffer(turned, up, window);
  double worst = 0;
  int inside = 0;
  for (int i = 0; i < window.columns; ++i)
    for (int j = 0; j < window.rows; ++j) {
      const Eigen::Vector3d sample =
          frame.to_world({window.x + (i + 0.5) * 0.01, window.y + (j + 0.5) * 0.01, corner.z()});
      const Eigen::Vector3d own = rotation.transpose() * (sample - shift);
      const double margin = std::min({own.x(), 4 - own.x(), own.y(), 3 - own.y()});
      if (std::abs(margin) < 0.01 / 128) continue;  // within the card's snapping of edges
      if (field.covered(i, j) != (margin > 0)) FAIL("coverage differs at (" << i << ", " << j << ")");
      if (margin <= 0) continue;
      ++inside;
      worst = std::max(worst, std::abs(field.upper(i, j) - corner.z() - (1 + 0.5 * own.x())));
      worst = std::max(worst, std::abs(field.lower(i, j) - corner.z()));
    }
  CHECK(inside == Approx(120000).epsilon(0.01));
  CHECK(worst <= 3 * 4 * depth_step);
}

TEST_CASE("the gap of a frustum shell reaches its closed form from below") {
  const solids::FrustumShell cup;
  const Shape shell = solids::frustum_shell(cup);
  const double exact = solids::frustum_shell_f_max(cup);
  for (const int samples : {100, 400, 1600}) {
    const double pixel = 8.4 / samples;
    const HeightField field =
        height_field_by_depth_buffer(shell, Direction(0, 0, 1), {-4.2, -4.2, pixel, samples, samples});
    const double largest = maximum_gap(field).value;
    CHECK(largest <= exact + cup.height * 1e-5);  // steep walls, single precision
    CHECK(largest >= exact - 8 * pixel);          // slope of the outer wall
    // A regular polygon of circumradius 4.
    const double area = 0.5 * cup.segments * 16 * std::sin(2 * std::acos(-1.0) / cup.segments);
    CHECK(covered_samples(field) * pixel * pixel == Approx(area).epsilon(4.0 / samples));
  }
}

TEST_CASE("tiles join without a seam") {
  const Shape shell = solids::frustum_shell({});
  const Window window{-5.5, -5.5, 10.0 / 257, 257, 301};
  const Direction oblique(0.2, -0.1, 1);
  const HeightField whole = height_field_by_depth_buffer(shell, oblique, window);
  const HeightField tiled = height_field_by_depth_buffer(shell, oblique, window, {64});
  int disagreements = 0;
  double worst = 0;
  for (int i = 0; i < window.columns; ++i)
    for (int j = 0; j < window.rows; ++j) {
      if (whole.covered(i, j) != tiled.covered(i, j)) ++disagreements;
      if (whole.covered(i, j) && tiled.covered(i, j))
        worst = std::max({worst, std::abs(whole.upper(i, j) - tiled.upper(i, j)),
                          std::abs(whole.lower(i, j) - tiled.lower(i, j))});
    }
  CHECK(covered_samples(whole) > 10000);
  CHECK(disagreements <= 5);  // a sample within 1/256 pixel of an edge
  CHECK(worst <= 1e-3);       // single precision on a wall of slope 8
}

TEST_CASE("a rasterizer kept for many directions answers like a fresh one") {
  const Shape shell = solids::frustum_shell({});
  DepthRasterizer rasterizer(shell);
  for (const Direction& direction : {Direction(0, 0, 1), Direction(1, 0, 0.5), Direction(0, 0, -1)}) {
    const Window window = authors_window(shell, direction);
    const HeightField kept = rasterizer.height_field(direction, window);
    const HeightField fresh = height_field_by_depth_buffer(shell, direction, window);
    CHECK(kept.upper == fresh.upper);
    CHECK(kept.lower == fresh.lower);
    CHECK(covered_samples(kept) > 100);
  }
}

TEST_CASE("turning the direction round swaps and negates the envelopes") {
  const Shape prism = slanted_prism({4, 3, 1}, 0.25);
  const HeightField up = height_field_by_depth_buffer(prism, Direction(0, 0, 1), {0, 0, 0.125, 32, 24});
  const HeightField down = height_field_by_depth_buffer(prism, Direction(0, 0, -1), {0, -3, 0.125, 32, 24});
  for (int i = 0; i < 32; ++i)
    for (int j = 0; j < 24; ++j) {
      REQUIRE(up.covered(i, j));
      CHECK(std::abs(up.upper(i, j) + down.lower(i, 23 - j)) < 4 * depth_step);
      CHECK(std::abs(up.lower(i, j) + down.upper(i, 23 - j)) < 4 * depth_step);
    }
}

TEST_CASE("the authors' framing is 200 pixels over the largest of 1.5 ex, 1.5 ey and 3 ez") {
  const Window wide = authors_window(slanted_prism({4, 2, 1}, 0), Direction(0, 0, 1));
  CHECK(wide.columns == 200);
  CHECK(wide.rows == 200);
  CHECK(wide.pixel_size == Approx(6.0 / 200));
  CHECK(wide.x == Approx(-1));
  CHECK(wide.y == Approx(-2));
  CHECK(authors_window(slanted_prism({4, 2, 3}, 0), Direction(0, 0, 1)).pixel_size == Approx(9.0 / 200));
  CHECK(authors_window(slanted_prism({1, 4, 1}, 0), Direction(0, 0, 1)).pixel_size == Approx(6.0 / 200));
}

TEST_CASE("vertices that no triangle uses change nothing, whatever they hold") {
  const Shape box = slanted_prism({1, 1, 1}, 0);
  Shape padded = box;
  padded.vertices.conservativeResize(10, 3);
  padded.vertices.row(8).setConstant(std::numeric_limits<double>::quiet_NaN());
  padded.vertices.row(9).setConstant(1e300);
  const Window window{0, 0, 0.125, 8, 8};
  const HeightField expected = height_field_by_depth_buffer(box, Direction(0, 0, 1), window);
  const HeightField field = height_field_by_depth_buffer(padded, Direction(0, 0, 1), window);
  CHECK(field.upper == expected.upper);
  CHECK(covered_samples(field) == 64);
}

TEST_CASE("flat shapes have a height, walls parallel to r have no pixels") {
  Points points(4, 3);
  points << 0, 0, 2, 1, 0, 2, 0, 1, 2, 1, 1, 2;
  Triangles triangles(2, 3);
  triangles << 0, 1, 2, 1, 3, 2;
  const Shape sheet = make_shape(points, triangles);
  const HeightField flat = height_field_by_depth_buffer(sheet, Direction(0, 0, 1), {0, 0, 0.25, 4, 4});
  CHECK(flat.upper == Eigen::MatrixXd::Constant(4, 4, 2));
  CHECK(flat.lower == Eigen::MatrixXd::Constant(4, 4, 2));
  CHECK(covered_samples(height_field_by_depth_buffer(sheet, Direction(1, 0, 0), {-3, -3, 0.25, 24, 24})) ==
        0);
}

TEST_CASE("a depth raster refuses windows and tiles that make no sense") {
  const Shape box = slanted_prism({1, 1, 1}, 0);
  const Direction up(0, 0, 1);
  const double nan = std::numeric_limits<double>::quiet_NaN();
  CHECK_THROWS_AS(height_field_by_depth_buffer(box, up, {0, 0, 0, 4, 4}), UsageError);
  CHECK_THROWS_AS(height_field_by_depth_buffer(box, up, {nan, 0, 1, 4, 4}), UsageError);
  CHECK_THROWS_AS(height_field_by_depth_buffer(box, up, {0, 0, 1, 0, 4}), UsageError);
  CHECK_THROWS_AS(height_field_by_depth_buffer(box, up, {0, 0, 1, 4, 16385}), UsageError);
  CHECK_THROWS_AS(height_field_by_depth_buffer(box, up, {0, 0, 1, 4, 4}, {0}), UsageError);
  CHECK_THROWS_AS(height_field_by_depth_buffer(Shape{}, up, {0, 0, 1, 4, 4}), InputError);
}

TEST_CASE("no display is needed, and a wrong one does no harm") {
  const Shape box = slanted_prism({1, 1, 1}, 0);
  const Window window{0, 0, 0.25, 4, 4};
  ::unsetenv("DISPLAY");
  const HeightField without = height_field_by_depth_buffer(box, Direction(0, 0, 1), window);
  ::setenv("DISPLAY", ":4242", 1);
  const HeightField wrong = height_field_by_depth_buffer(box, Direction(0, 0, 1), window);
  ::unsetenv("DISPLAY");
  CHECK(covered_samples(without) == 16);
  CHECK(wrong.upper == without.upper);
}
