#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "mesh/planar.h"
#include "support/catch.h"
#include "support/point_sets.h"

using namespace stackabilization;
using point_sets::Random;

namespace {

Eigen::Matrix2Xd polygon(const std::vector<Eigen::Vector2d>& corners) {
  Eigen::Matrix2Xd result(2, static_cast<Eigen::Index>(corners.size()));
  for (std::size_t c = 0; c < corners.size(); ++c) result.col(static_cast<Eigen::Index>(c)) = corners[c];
  return result;
}

/// Corners of the hull of random points.
Eigen::Matrix2Xd random_polygon(Random& random, int points) {
  Eigen::Matrix2Xd cloud(2, points);
  for (int k = 0; k < points; ++k) cloud.col(k) = random.vector(1).head<2>();
  std::vector<Eigen::Vector2d> corners;
  for (const int corner : convex_polygon(cloud, 0)) corners.push_back(cloud.col(corner));
  return polygon(corners);
}

double area_along(const Eigen::Matrix2Xd& corners, const Eigen::Vector2d& axis) {
  const Eigen::RowVectorXd x = axis.transpose() * corners;
  const Eigen::RowVectorXd y = Eigen::RowVector2d(-axis.y(), axis.x()) * corners;
  return (x.maxCoeff() - x.minCoeff()) * (y.maxCoeff() - y.minCoeff());
}

}  // namespace

TEST_CASE("a convex polygon goes counter-clockwise from its lexicographically smallest corner") {
  // Inner, repeated and collinear points are no corners.
  const Eigen::Matrix2Xd points =
      polygon({{2, 2}, {1, 1}, {0, 2}, {2, 0}, {0, 0}, {1, 0}, {2, 1}, {0, 0}, {0.5, 1.5}});
  CHECK(convex_polygon(points, 0) == std::vector<int>{4, 3, 0, 2});
  CHECK(convex_polygon(polygon({{1, 1}, {3, 3}, {2, 2}}), 0) == std::vector<int>{0, 1});
  CHECK(convex_polygon(polygon({{1, 1}, {1, 1}}), 0).size() == 1);
}

TEST_CASE("the minimal rectangle of a turned rectangle is that rectangle") {
  const Eigen::Matrix2Xd corners = polygon({{0, 0}, {3, 0}, {3, 1}, {0, 1}});
  for (int k = 0; k < 40; ++k) {
    const Eigen::Rotation2Dd rotation(0.17 * k);
    const PlanarRectangle found =
        minimal_rectangle((rotation.toRotationMatrix() * corners).colwise() + Eigen::Vector2d(5, -2));
    CHECK(found.area() == Approx(3).epsilon(1e-14));
    CHECK(found.size.maxCoeff() == Approx(3).epsilon(1e-14));
    CHECK((found.centre - rotation * Eigen::Vector2d(1.5, 0.5) - Eigen::Vector2d(5, -2)).norm() < 1e-14);
    const double along = std::abs(found.axis.dot(rotation * Eigen::Vector2d::UnitX()));
    CHECK(along == Approx(found.size.x() > found.size.y() ? 1 : 0).margin(1e-14));
  }
}

TEST_CASE("minimal rectangles in closed form") {
  // Over any side of a triangle without obtuse angle the rectangle has twice its area; among equals the
  // first.
  const PlanarRectangle triangle = minimal_rectangle(polygon({{0, 0}, {4, 0}, {0, 3}}));
  CHECK(triangle.area() == Approx(12).epsilon(1e-14));
  CHECK(triangle.size == Eigen::Vector2d(4, 3));
  std::vector<Eigen::Vector2d> hexagon;
  for (int k = 0; k < 6; ++k)
    hexagon.push_back(Eigen::Rotation2Dd(0.2 + k * std::acos(0.5)) * Eigen::Vector2d(1, 0));
  CHECK(minimal_rectangle(polygon(hexagon)).area() == Approx(2 * std::sqrt(3)).epsilon(1e-14));

  const PlanarRectangle segment = minimal_rectangle(polygon({{1, 1}, {4, 5}}));
  CHECK(segment.area() == Approx(0).margin(1e-14));
  CHECK(segment.size.maxCoeff() == Approx(5));
  const PlanarRectangle point = minimal_rectangle(polygon({{1, 2}}));
  CHECK(point.size.isZero(0));
  CHECK(point.centre == Eigen::Vector2d(1, 2));
}

TEST_CASE(
    "no rectangle over a side or along any axis is smaller than the minimal one, which holds the polygon") {
  Random random(31);
  for (int round = 0; round < 200; ++round) {
    const Eigen::Matrix2Xd corners = random_polygon(random, 3 + round % 40);
    const PlanarRectangle found = minimal_rectangle(corners);
    double least = std::numeric_limits<double>::infinity();
    for (Eigen::Index c = 0; c < corners.cols(); ++c)
      least = std::min(
          least, area_along(corners, (corners.col((c + 1) % corners.cols()) - corners.col(c)).normalized()));
    CHECK(found.area() == Approx(least).epsilon(1e-13));
    for (int k = 0; k < 100; ++k)
      CHECK(area_along(corners, Eigen::Rotation2Dd(0.016 * k) * Eigen::Vector2d(1, 0)) >=
            found.area() * (1 - 1e-13));
    const Eigen::Vector2d across(-found.axis.y(), found.axis.x());
    const Eigen::Matrix2Xd centred = corners.colwise() - found.centre;
    CHECK((found.axis.transpose() * centred).cwiseAbs().maxCoeff() <= found.size.x() / 2 + 1e-14);
    CHECK((across.transpose() * centred).cwiseAbs().maxCoeff() <= found.size.y() / 2 + 1e-14);
  }
}
