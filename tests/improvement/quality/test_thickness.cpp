#include <tbb/global_control.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <numbers>
#include <set>

#include "improvement/quality/thickness.h"
#include "stackabilization/core/errors.h"
#include "support/catch.h"
#include "support/solids.h"
#include "support/variants.h"

namespace stackabilization {
namespace {

std::vector<double> sorted_thicknesses(const Shape& shape) {
  std::vector<double> result;
  for (const ThicknessProbe& probe : thickness_probes(shape)) result.push_back(probe.at_rest);
  std::sort(result.begin(), result.end());
  return result;
}

Eigen::Vector3d normal_of(const Shape& shape, Eigen::Index triangle) {
  return (shape.corner(triangle, 1) - shape.corner(triangle, 0))
      .cross(shape.corner(triangle, 2) - shape.corner(triangle, 0))
      .normalized();
}

TEST_CASE("a box is as thick as its sides, by their areas") {
  const Eigen::Vector3d size(2, 3, 4);
  const Shape box = solids::box(size);
  const std::vector<ThicknessProbe> probes = thickness_probes(box);
  CHECK(probes.size() == 2000);
  Eigen::Vector3d counts = Eigen::Vector3d::Zero();
  for (const ThicknessProbe& probe : probes) {
    const Eigen::Vector3d normal = normal_of(box, probe.near_triangle).cwiseAbs();
    CHECK(probe.at_rest == Approx(normal.dot(size)));
    CHECK(thickness(probe, box) == probe.at_rest);
    for (const Eigen::Vector3d& weights : {probe.near_weights, probe.far_weights}) {
      CHECK(weights.sum() == Approx(1));
      CHECK(weights.minCoeff() > -1e-9);
    }
    counts += normal;
  }
  for (int axis = 0; axis < 3; ++axis) CHECK(counts(axis) == Approx(2000 * (24 / size(axis)) / 26).margin(3));
}

TEST_CASE("a box after scaling is as thick as its new sides") {
  const Eigen::Vector3d size(2, 3, 4), factors(0.5, 2, 0.1);
  const Shape box = solids::box(size), scaled = transformed(box, factors.asDiagonal(), {5, 6, 7});
  for (const ThicknessProbe& probe : thickness_probes(box))
    CHECK(thickness(probe, scaled) ==
          Approx(normal_of(box, probe.near_triangle).cwiseAbs().dot(size.cwiseProduct(factors))));
}

TEST_CASE("the wall of a cup is measured between its facets, not across the cup") {
  solids::FrustumShell cup;
  cup.inner_top = cup.inner_bottom + 1 / cup.height * (cup.height - cup.floor);
  const Shape shape = solids::frustum_shell(cup);
  // Parallel facets: apothems differ alike at every height.
  const double turn = std::cos(std::numbers::pi / cup.segments);
  const double slope = turn * (cup.outer_top - cup.outer_bottom) / cup.height;
  const double outer = cup.outer_bottom + cup.floor / cup.height * (cup.outer_top - cup.outer_bottom);
  const double wall = turn * (outer - cup.inner_bottom) / std::sqrt(1 + slope * slope);
  int on_walls = 0, in_wall = 0, in_floor = 0;
  for (const ThicknessProbe& probe : thickness_probes(shape)) {
    const double rise = std::abs(normal_of(shape, probe.near_triangle).z());
    on_walls += rise < 0.5;
    in_wall += rise < 0.5 && probe.at_rest == Approx(wall);
    in_floor += rise > 0.5 && probe.at_rest == Approx(cup.floor);
  }
  CHECK(on_walls > 1000);
  CHECK(in_wall > 0.8 * on_walls);  // the others look into the floor or the rim
  CHECK(in_floor > 100);
}

TEST_CASE("the same places are found whichever way triangles are turned") {
  const Shape cup = solids::frustum_shell({});
  const std::vector<double> expected = sorted_thicknesses(cup);
  const std::vector<double> turned = sorted_thicknesses(solids::flipped(cup));
  CHECK(turned.size() == Approx(expected.size()).epsilon(0.01));
  // Corners are counted from elsewhere, so the points within triangles are others.
  for (const double share : {0.25, 0.5, 0.75}) {
    const auto at = static_cast<std::size_t>(share * static_cast<double>(expected.size()));
    CHECK(turned[at] == Approx(expected[at]).epsilon(0.05));
  }

  Shape half = solids::box(Eigen::Vector3d(1, 1, 1));
  for (Eigen::Index t = 0; t < half.triangle_count(); t += 2)
    std::swap(half.triangles(t, 0), half.triangles(t, 1));
  const std::vector<ThicknessProbe> probes = thickness_probes(half);
  CHECK(probes.size() == 2000);
  for (const ThicknessProbe& probe : probes) CHECK(probe.at_rest == Approx(1));
}

TEST_CASE("a leg that stands in a seat is as thick there as below") {
  const Shape seat = solids::box({-4, -4, 5}, {4, 4, 6}), leg = solids::box({-1, -1, 0}, {1, 1, 5.5});
  const Shape stool = concatenate(seat, leg);
  for (const ThicknessProbe& probe : thickness_probes(stool)) {
    const Eigen::Vector3d normal = normal_of(stool, probe.near_triangle).cwiseAbs();
    const bool of_seat = stool.triangle_part[static_cast<std::size_t>(probe.near_triangle)] == 0;
    CHECK(probe.at_rest ==
          Approx(normal.dot(of_seat ? Eigen::Vector3d(8, 8, 1) : Eigen::Vector3d(2, 2, 5.5))));
  }
}

TEST_CASE("every part with material has a probe, however small") {
  Shape shape = solids::box(Eigen::Vector3d(100, 100, 100));
  for (int k = 0; k < 5; ++k)
    shape = concatenate(shape, solids::box(Eigen::Vector3d(200, k, 0), Eigen::Vector3d(200.1, k + 0.1, 0.1)));
  std::set<std::int32_t> probed;
  for (const ThicknessProbe& probe : thickness_probes(shape, {7}))
    probed.insert(shape.triangle_part[static_cast<std::size_t>(probe.near_triangle)]);
  CHECK(probed.size() == 6);
}

TEST_CASE("probes are the same for any number of threads") {
  const Shape cup = solids::frustum_shell({});
  const std::vector<ThicknessProbe> expected = thickness_probes(cup);
  const tbb::global_control one(tbb::global_control::max_allowed_parallelism, 1);
  const std::vector<ThicknessProbe> alone = thickness_probes(cup);
  REQUIRE(alone.size() == expected.size());
  for (std::size_t k = 0; k < alone.size(); ++k) {
    CHECK(alone[k].far_triangle == expected[k].far_triangle);
    CHECK(alone[k].at_rest == expected[k].at_rest);
  }
}

TEST_CASE("sheets have no thickness") {
  Points corners(4, 3);
  corners << 0, 0, 0, 3, 0, 0, 0, 3, 0, 3, 3, 0;
  Triangles one(2, 3), both(4, 3);
  one << 0, 1, 2, 1, 3, 2;
  both << one, 0, 2, 1, 1, 2, 3;
  CHECK(thickness_probes(make_shape(corners, one)).empty());
  CHECK(thickness_probes(make_shape(corners, both)).empty());
}

TEST_CASE("thickness refuses what cannot be asked") {
  const Shape box = solids::box(Eigen::Vector3d(1, 1, 1));
  CHECK_THROWS_AS(thickness_probes(box, {0}), UsageError);
  CHECK_THROWS_AS(thickness_probes(Shape{}), InputError);
  Points straight(3, 3);
  straight << 0, 0, 0, 1, 1, 1, 2, 2, 2;
  Triangles triangle(1, 3);
  triangle << 0, 1, 2;
  CHECK_THROWS_AS(thickness_probes(make_shape(straight, triangle)), InputError);
}

TEST_CASE("a finely cut ball is as thick as its diameter everywhere") {
  const Shape ball = solids::sphere(1, 6);
  const std::vector<ThicknessProbe> probes = thickness_probes(ball);
  CHECK(probes.size() > 1990);
  for (const ThicknessProbe& probe : probes) CHECK(probe.at_rest == Approx(2).epsilon(0.01));
}

}  // namespace
}  // namespace stackabilization
