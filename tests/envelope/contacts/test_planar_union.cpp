#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <random>

#include "envelope/contacts/planar_union.h"
#include "support/catch.h"

using namespace stackabilization::detail;

namespace {

ConvexPolygon rectangle(double left, double bottom, double right, double top) {
  return {{left, bottom}, {right, bottom}, {right, top}, {left, top}};
}

/// The square [0, 8]^2 without the square [2, 6]^2.
std::vector<ConvexPolygon> frame() {
  return {rectangle(0, 0, 8, 2), rectangle(6, 1, 8, 7), rectangle(0, 6, 8, 8), rectangle(0, 1, 2, 7)};
}

/// Side of a cell of the bitmap over [0, 8]^2.
constexpr double cell = 8.0 / 254;

std::vector<ConvexPolygon> turned(std::vector<ConvexPolygon> outlines, double angle) {
  const Eigen::Rotation2Dd rotation(angle);
  for (ConvexPolygon& outline : outlines)
    for (Eigen::Vector2d& p : outline) p = rotation * p;
  return outlines;
}

}  // namespace

TEST_CASE("a union counts what outlines share once and holes not at all") {
  CHECK(union_area({rectangle(0, 0, 2, 3)}) == Approx(6).epsilon(1e-8));
  CHECK(union_area({rectangle(0, 0, 2, 2), rectangle(1, 1, 3, 3)}) == Approx(7).epsilon(1e-8));
  CHECK(union_area({rectangle(0, 0, 9, 9), rectangle(1, 1, 3, 3)}) == Approx(81).epsilon(1e-8));
  CHECK(union_area({rectangle(0, 0, 1, 1), rectangle(5, 0, 6, 1), rectangle(5, 0, 6, 1)}) ==
        Approx(2).epsilon(1e-8));
  CHECK(union_area(frame()) == Approx(48).epsilon(1e-8));
  for (const double angle : {0.3, 1.0, 2.5})
    CHECK(union_area(turned(frame(), angle)) == Approx(48).epsilon(1e-8));
}

TEST_CASE("a union does not care which way an outline runs, and gains nothing from segments and points") {
  ConvexPolygon clockwise = rectangle(1, 1, 3, 3);
  std::reverse(clockwise.begin(), clockwise.end());
  const ConvexPolygon segment = {{0, 0}, {3, 3}}, point = {{0.5, 0.5}};
  CHECK(union_area({rectangle(0, 0, 2, 2), clockwise, segment, point}) == Approx(7).epsilon(1e-8));
  CHECK(union_area({segment, point}) == 0);
  CHECK(union_area({point}) == 0);
}

TEST_CASE(
    "outlines that share edges, corners and whole sides are united without a crack or a doubled strip") {
  std::vector<ConvexPolygon>
      tiles;  // triangles of a fan and its mirror image, squares, and some of them again
  for (int i = 0; i < 12; ++i)
    for (int j = 0; j < 12; ++j) {
      tiles.push_back(rectangle(i, j, i + 1, j + 1));
      tiles.push_back({{i + 0.0, j + 0.0}, {i + 1.0, j + 0.0}, {i + 1.0, j + 1.0}});
      if (i < 11) tiles.push_back(rectangle(i + 0.5, j, i + 1.5, j + 1));
    }
  CHECK(union_area(tiles) == Approx(144).epsilon(1e-8));
  for (const double angle : {1e-9, 1e-7, 0.3, 1.0}) {
    CHECK(union_area(turned(tiles, angle)) == Approx(144).epsilon(1e-6));
    if (angle > 1e-3) continue;
    std::vector<ConvexPolygon> both = tiles;  // edges that all but coincide
    for (const ConvexPolygon& tile : turned(tiles, angle)) both.push_back(tile);
    CHECK(union_area(both) == Approx(144).epsilon(1e-6));
  }
}

TEST_CASE("unions of random slivers agree with lines across them") {
  std::mt19937 random(7);
  const auto number = [&](double low, double high) {
    return low + (high - low) * static_cast<double>(random()) / 4294967296.0;
  };
  for (int round = 0; round < 20; ++round) {
    std::vector<ConvexPolygon> slivers;
    for (int k = 0; k < 60; ++k) {
      const Eigen::Vector2d a(number(0, 1), number(0, 1)), b(number(0, 1), number(0, 1));
      const double width = std::pow(10, number(-9, -0.5));
      slivers.push_back({a, b, b + width * Eigen::Vector2d(number(-1, 1), number(-1, 1))});
    }
    std::vector<ConvexPolygon> many;  // the same union, of so many that it is measured by lines
    while (many.size() <= 4096) many.insert(many.end(), slivers.begin(), slivers.end());
    CHECK(std::abs(union_area(slivers) - union_area(many)) <= 1e-3);
  }
}

TEST_CASE("a union of thousands of outlines, many deep, is measured to a thousandth of their rectangle") {
  std::vector<ConvexPolygon> many;
  for (int k = 0; k < 1500; ++k)  // the bars of a frame, lying many deep
    for (const ConvexPolygon& bar : frame()) many.push_back(bar);
  CHECK(many.size() > 4096);
  CHECK(std::abs(union_area(many) - 48) <= 1e-3 * 64);
  for (const double angle : {0.3, 1.0, 2.5})
    CHECK(std::abs(union_area(turned(many, angle)) - 48) <= 1e-3 * 2 * 64);
  const std::vector<ConvexPolygon> segments(5000, ConvexPolygon{{0, 0}, {3, 3}});
  CHECK(union_area(segments) == 0);
  CHECK(union_area(std::vector<ConvexPolygon>(5000, ConvexPolygon{{0, 1}, {3, 1}})) == 0);
}

TEST_CASE("the largest hole is the one inside a frame, to a cell of the bitmap") {
  CHECK(largest_hole(frame()) <= 16);
  CHECK(largest_hole(frame()) >= std::pow(4 - 2 * cell, 2));
  for (const double angle : {0.3, 1.0, 2.5}) {
    CHECK(largest_hole(turned(frame(), angle)) <= 16);
    CHECK(largest_hole(turned(frame(), angle)) >= std::pow(4 - 6 * cell, 2));
  }
}

TEST_CASE("of two holes the larger counts") {
  std::vector<ConvexPolygon> outlines = frame();
  outlines.push_back(rectangle(3, 1, 4, 7));  // leaves [2, 3] x [2, 6] and [4, 6] x [2, 6]
  CHECK(largest_hole(outlines) <= 8);
  CHECK(largest_hole(outlines) >= (2 - 2 * cell) * (4 - 2 * cell));
}

TEST_CASE("bays, cracks and full patches are no holes") {
  std::vector<ConvexPolygon> bay = frame();
  bay.pop_back();
  CHECK(largest_hole(bay) == 0);
  CHECK(largest_hole({rectangle(0, 0, 8, 4 - cell / 8), rectangle(0, 4 + cell / 8, 8, 8)}) == 0);
  CHECK(largest_hole({rectangle(0, 0, 8, 8)}) == 0);
  CHECK(largest_hole({ConvexPolygon{{1, 1}}}) == 0);
}
