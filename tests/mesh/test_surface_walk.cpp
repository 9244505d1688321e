#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>

#include "mesh/segment_triangle.h"
#include "mesh/surface_walk.h"
#include "support/catch.h"
#include "support/point_sets.h"
#include "support/solids.h"

namespace stackabilization::surface_walk_test {

using namespace detail;

namespace {

/// The unit square in n x n squares, each of two triangles.
Shape grid(int n) {
  Shape shape;
  shape.vertices.resize((n + 1) * (n + 1), 3);
  for (int i = 0; i <= n; ++i)
    for (int j = 0; j <= n; ++j) shape.vertices.row(i * (n + 1) + j) << 1.0 * i / n, 1.0 * j / n, 0;
  shape.triangles.resize(2 * n * n, 3);
  for (int i = 0; i < n; ++i)
    for (int j = 0; j < n; ++j) {
      const int a = i * (n + 1) + j, b = a + n + 1;
      shape.triangles.row(2 * (i * n + j)) << a, b, b + 1;
      shape.triangles.row(2 * (i * n + j) + 1) << a, b + 1, a + 1;
    }
  shape.triangle_part.assign(static_cast<std::size_t>(shape.triangle_count()), 0);
  shape.part_names = {"grid"};
  return shape;
}

double least_distance(const Shape& shape, const Eigen::Vector3d& point, int part = 0) {
  double least = std::numeric_limits<double>::infinity();
  for (Eigen::Index t = 0; t < shape.triangle_count(); ++t) {
    if (shape.triangle_part[static_cast<std::size_t>(t)] != part) continue;
    const Corners corners{shape.corner(t, 0), shape.corner(t, 1), shape.corner(t, 2)};
    least = std::min(least, (nearest_on_triangle(point, corners) - point).norm());
  }
  return least;
}

double walked(const Shape& shape, const Eigen::Vector3d& point, std::int32_t start) {
  return SurfaceWalk(shape, weld(shape)).distance(shape, point, start);
}

}  // namespace

TEST_CASE("a walk over a flat surface ends at the nearest point") {
  const Shape shape = grid(4);
  point_sets::Random random(5);
  for (int trial = 0; trial < 50; ++trial) {
    const Eigen::Vector3d point = random.vector(1.5);
    for (const std::int32_t start : {0, 13, 31})
      CHECK(walked(shape, point, start) == Approx(least_distance(shape, point)).margin(1e-14));
  }
}

TEST_CASE("a walk is never nearer than the surface, and finds it around the corners of a box") {
  const Shape box = solids::box({0, 0, 0}, {1, 2, 3});
  point_sets::Random random(6);
  for (int trial = 0; trial < 50; ++trial) {
    const Eigen::Vector3d point = 3 * random.vector(1);
    const double least = least_distance(box, point);
    double best = std::numeric_limits<double>::infinity();
    for (std::int32_t start = 0; start < 12; ++start) {
      const double found = walked(box, point, start);
      CHECK(found >= least - 1e-14);
      best = std::min(best, found);
    }
    CHECK(best == Approx(least).margin(1e-14));
    const bool outside = (point.array() < 0).any() || point.x() > 1 || point.y() > 2 || point.z() > 3;
    if (outside)
      for (std::int32_t start = 0; start < 12; ++start)
        CHECK(walked(box, point, start) == Approx(least).margin(1e-14));
  }
}

TEST_CASE("a walk stays on the part where it starts") {
  Shape shape = grid(2);
  for (std::size_t t = 4; t < shape.triangle_part.size(); ++t) shape.triangle_part[t] = 1;
  shape.part_names = {"left", "right"};
  const Eigen::Vector3d right(0.9, 0.5, 0);
  CHECK(walked(shape, right, 0) == Approx(0.4));
  CHECK(walked(shape, right, 4) == Approx(0).margin(1e-14));
}

TEST_CASE("a walk goes over what has collapsed since the shape was at rest") {
  const Shape rest = grid(1);
  Shape now = rest;
  now.vertices.row(1) = now.vertices.row(3);  // the second triangle is a line
  const SurfaceWalk walk(rest, weld(rest));
  CHECK(walk.distance(now, {1, 0.5, 0.25}, 1) == Approx(0.25));
  CHECK(std::isfinite(walk.distance(now, {5, 5, 5}, 1)));
}

}  // namespace stackabilization::surface_walk_test
