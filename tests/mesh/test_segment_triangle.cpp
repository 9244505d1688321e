#include <Eigen/Dense>
#include <Eigen/Geometry>
#include <algorithm>
#include <numbers>

#include "mesh/segment_triangle.h"
#include "support/catch.h"
#include "support/point_sets.h"

namespace stackabilization::segment_triangle_test {

using namespace detail;

namespace {

const Corners unit_triangle = {Eigen::Vector3d(0, 0, 0), Eigen::Vector3d(1, 0, 0), Eigen::Vector3d(0, 1, 0)};

Corners random_triangle(point_sets::Random& random) {
  for (;;) {
    const Corners triangle = {random.vector(1), random.vector(1), random.vector(1)};
    if ((triangle[1] - triangle[0]).cross(triangle[2] - triangle[0]).norm() > 0.05) return triangle;
  }
}

/// q is the nearest point of a convex set exactly if the set lies behind the plane through q across p - q.
void check_nearest(const Eigen::Vector3d& p, const Corners& triangle) {
  const Eigen::Vector3d q = nearest_on_triangle(p, triangle);
  for (const Eigen::Vector3d& corner : triangle) CHECK((p - q).dot(corner - q) <= 1e-12);
  Eigen::Matrix<double, 3, 2> sides;
  sides << triangle[1] - triangle[0], triangle[2] - triangle[0];
  const Eigen::Vector2d weights = sides.colPivHouseholderQr().solve(q - triangle[0]);
  CHECK((sides * weights - (q - triangle[0])).norm() <= 1e-12);
  CHECK(weights.minCoeff() >= -1e-10);
  CHECK(weights.sum() <= 1 + 1e-10);
}

Eigen::Vector3d along(const Segment& segment, double place) {
  return segment[0] + place * (segment[1] - segment[0]);
}

double distance(const Segment& segment, double place, const Corners& triangle) {
  const Eigen::Vector3d p = along(segment, place);
  return (nearest_on_triangle(p, triangle) - p).norm();
}

/// Least of a function that is convex on [0, 1].
template <typename Function>
double convex_minimum(const Function& function) {
  double low = 0, high = 1;
  for (int k = 0; k < 200; ++k) {
    const double a = low + (high - low) / 3, b = high - (high - low) / 3;
    (function(a) < function(b) ? high : low) = function(a) < function(b) ? b : a;
  }
  return function((low + high) / 2);
}

}  // namespace

TEST_CASE("every region around a triangle has its nearest point") {
  const auto nearest = [](double x, double y) { return nearest_on_triangle({x, y, 2}, unit_triangle); };
  CHECK(nearest(0.25, 0.25) == Eigen::Vector3d(0.25, 0.25, 0));
  CHECK(nearest(-1, -1) == unit_triangle[0]);
  CHECK(nearest(3, 0.5) == unit_triangle[1]);
  CHECK(nearest(-0.5, 2) == unit_triangle[2]);
  CHECK(nearest(0.5, -3) == Eigen::Vector3d(0.5, 0, 0));
  CHECK(nearest(-3, 0.25) == Eigen::Vector3d(0, 0.25, 0));
  CHECK((nearest(1, 1) - Eigen::Vector3d(0.5, 0.5, 0)).norm() < 1e-15);
}

TEST_CASE("the nearest point of a triangle is told from a plane that separates it from the point") {
  point_sets::Random random(17);
  for (int k = 0; k < 2000; ++k) {
    const Corners triangle = random_triangle(random);
    check_nearest(random.vector(3), triangle);
    check_nearest(triangle[0] + 0.5 * (triangle[1] - triangle[0]), triangle);
    check_nearest(triangle[2], triangle);
  }
}

TEST_CASE("where a segment comes nearest to a triangle, in closed form") {
  const auto of = [](const Eigen::Vector3d& from, const Eigen::Vector3d& to) {
    return approach({from, to}, unit_triangle, 1e-12);
  };
  SECTION("through its inside") {
    const Approach found = of({0.25, 0.25, -1}, {0.25, 0.25, 3});
    CHECK(found.distance == Approx(0).margin(1e-15));
    CHECK(found.low == Approx(0.25).epsilon(1e-12));
    CHECK(found.high == Approx(0.25).epsilon(1e-12));
  }
  SECTION("past a side, askew") {
    const Approach found = of({0.5, -1, -1}, {0.5, -1, 1});
    CHECK(found.distance == Approx(1).epsilon(1e-14));
    CHECK(found.low == Approx(0.5).epsilon(1e-12));
    CHECK(found.high == Approx(0.5).epsilon(1e-12));
  }
  SECTION("in parallel above it, where it is as near all the way over") {
    // Over the triangle from x = 0 to x = 0.75 at y = 0.25.
    const Approach found = of({-1, 0.25, 0.5}, {3, 0.25, 0.5});
    CHECK(found.distance == Approx(0.5).epsilon(1e-14));
    CHECK(found.low == Approx(0.25).epsilon(1e-12));
    CHECK(found.high == Approx(1.75 / 4).epsilon(1e-12));
  }
  SECTION("in its plane") {
    const Approach found = of({-1, 0.5, 0}, {1, 0.5, 0});
    CHECK(found.distance == Approx(0).margin(1e-15));
    CHECK(found.low == Approx(0.5).epsilon(1e-12));
    CHECK(found.high == Approx(0.75).epsilon(1e-12));
  }
  SECTION("along one of its sides") {
    const Approach found = of({0, 0, 0}, {1, 0, 0});
    CHECK(found.distance == Approx(0).margin(1e-15));
    CHECK(found.low == 0);
    CHECK(found.high == 1);
  }
  SECTION("ending above it") {
    const Approach found = of({0.25, 0.25, 0.125}, {0.25, 0.5, 4});
    CHECK(found.distance == Approx(0.125).epsilon(1e-14));
    CHECK(found.low == 0);
    CHECK(found.high == Approx(0).margin(1e-12));
  }
}

TEST_CASE("the approach of a segment is the least distance along it") {
  point_sets::Random random(23);
  for (int k = 0; k < 2000; ++k) {
    const Corners triangle = random_triangle(random);
    Segment segment = {random.vector(2), random.vector(2)};
    if (k % 4 == 0) segment[1] = segment[0] + (triangle[1] - triangle[0]);          // in parallel to a side
    if (k % 4 == 1) segment = {triangle[0], triangle[0] + random.unit()};           // from a corner
    if (k % 8 == 2) segment = {random.vector(2), (triangle[0] + triangle[1]) / 2};  // to a side
    const Approach found = approach(segment, triangle, 1e-9);
    const double least = convex_minimum([&](double place) { return distance(segment, place, triangle); });
    CHECK(found.distance == Approx(least).margin(1e-9));
    REQUIRE(found.low <= found.high);
    for (const double place : {found.low, (found.low + found.high) / 2, found.high})
      CHECK(distance(segment, place, triangle) <= least + 2e-9);
    // Beyond the ends of the stretch it is farther away.
    const double length = (segment[1] - segment[0]).norm(), step = 1e-2 / length;
    if (found.low > step) CHECK(distance(segment, found.low - step, triangle) > found.distance + 1e-9);
    if (found.high < 1 - step) CHECK(distance(segment, found.high + step, triangle) > found.distance + 1e-9);
  }
}

TEST_CASE("an approach does not depend on the pose, the order of corners or the way along the segment") {
  point_sets::Random random(29);
  for (int k = 0; k < 300; ++k) {
    const Corners triangle = random_triangle(random);
    const Segment segment = {random.vector(2), random.vector(2)};
    const Approach found = approach(segment, triangle, 1e-9);
    const Eigen::Isometry3d pose =
        Eigen::Translation3d(random.vector(5)) * Eigen::Quaterniond(random.rotation());
    const Approach moved = approach({pose * segment[0], pose * segment[1]},
                                    {pose * triangle[1], pose * triangle[2], pose * triangle[0]}, 1e-9);
    CHECK(moved.distance == Approx(found.distance).margin(1e-12));
    const Approach back = approach({segment[1], segment[0]}, {triangle[2], triangle[1], triangle[0]}, 1e-9);
    CHECK(back.distance == Approx(found.distance).margin(1e-12));
    CHECK(back.low == Approx(1 - found.high).margin(1e-6));
    CHECK(back.high == Approx(1 - found.low).margin(1e-6));
  }
}

}  // namespace stackabilization::segment_triangle_test
