#include <algorithm>
#include <cmath>

#include "stackabilization/core/errors.h"
#include "structure/joints/part_interfaces.h"
#include "support/catch.h"
#include "support/messages.h"
#include "support/symmetric_solids.h"

namespace stackabilization::part_interfaces_test {

using detail::InterfaceOptions;
using detail::part_interfaces;
using detail::PartInterface;
using detail::PartSurface;

namespace {

constexpr InterfaceOptions usual = {0.1, 0.3};

PartSurface surface(const Shape& shape) {
  return {shape, {"part", cuboid_of(axis_aligned_box(shape.vertices)), {}}};
}

std::vector<PartInterface> spots_of(const Shape& a, const Shape& b, const InterfaceOptions& options = usual) {
  return part_interfaces(surface(a), surface(b), options);
}

/// The lowest and the highest coordinates of a region, from its hull.
Eigen::Matrix<double, 2, 3> box_of(const PartInterface& spot) {
  Eigen::Matrix<double, 2, 3> box;
  box << spot.region.hull.colwise().minCoeff(), spot.region.hull.colwise().maxCoeff();
  return box;
}

void check_box(const PartInterface& spot, const Eigen::Vector3d& low, const Eigen::Vector3d& high) {
  INFO(box_of(spot));
  CHECK((box_of(spot).row(0).transpose() - low).norm() < 1e-12);
  CHECK((box_of(spot).row(1).transpose() - high).norm() < 1e-12);
}

const Shape plate = solids::box({-5, -5, 0}, {5, 5, 1});

}  // namespace

TEST_CASE("boxes that touch meet in the rectangle that their faces share, however finely they are cut") {
  const Shape post = solids::box({1, 4, 1}, {3, 7, 6});
  for (int level = 0; level < 3; ++level) {
    const std::vector<PartInterface> spots =
        spots_of(solids::finely(plate, 2 - level), solids::finely(post, level));
    REQUIRE(spots.size() == 1);
    CHECK(spots[0].gap == Approx(0).margin(1e-12));
    check_box(spots[0], {1, 4, 1}, {3, 5, 1});
    CHECK(spots[0].region.length(0) == Approx(2).epsilon(1e-12));
    CHECK(spots[0].region.length(1) == Approx(1).epsilon(1e-12));
    CHECK(spots[0].region.length(2) == Approx(0).margin(1e-12));
    CHECK((spots[0].region.centre - Eigen::Vector3d(2, 4.5, 1)).norm() < 1e-12);
  }
}

TEST_CASE("boxes near each other meet midway between them, and not beyond the reach") {
  for (const double gap : {0.02, 0.05, 0.09}) {
    const std::vector<PartInterface> spots = spots_of(plate, solids::box({1, 2, 1 + gap}, {3, 3, 6}));
    REQUIRE(spots.size() == 1);
    CHECK(spots[0].gap == Approx(gap).epsilon(1e-9));
    check_box(spots[0], {1, 2, 1 + gap / 2}, {3, 3, 1 + gap / 2});
  }
  CHECK(spots_of(plate, solids::box({1, 2, 1.11}, {3, 3, 6})).empty());
  CHECK(spots_of(plate, solids::box({1, 2, 1.11}, {3, 3, 6}), {0.12, 0.3}).size() == 1);
}

TEST_CASE("edges that touch meet in a segment, corners in a point") {
  const Shape cube = solids::box({0, 0, 0}, {1, 1, 1});
  const std::vector<PartInterface> edge = spots_of(cube, solids::box({1, 1, 0.25}, {2, 2, 3}), {1e-3, 0.3});
  REQUIRE(edge.size() == 1);
  check_box(edge[0], {1, 1, 0.25}, {1, 1, 1});
  const std::vector<PartInterface> corner = spots_of(cube, solids::box({1, 1, 1}, {2, 2, 3}), {1e-3, 0.3});
  REQUIRE(corner.size() == 1);
  check_box(corner[0], {1, 1, 1}, {1, 1, 1});
}

TEST_CASE("what one part has inside the other belongs to where they meet") {
  SECTION("a post that goes into a plate") {
    const std::vector<PartInterface> spots = spots_of(plate, solids::box({1, 2, 0.5}, {3, 3, 6}));
    REQUIRE(spots.size() == 1);
    CHECK(spots[0].gap == 0);
    check_box(spots[0], {1, 2, 0.5}, {3, 3, 1});
  }
  SECTION("a post that goes through it") {
    const std::vector<PartInterface> spots = spots_of(plate, solids::box({1, 2, -3}, {3, 3, 6}));
    REQUIRE(spots.size() == 1);
    check_box(spots[0], {1, 2, 0}, {3, 3, 1});
  }
  SECTION("a block that lies within it") {
    const std::vector<PartInterface> spots = spots_of(plate, solids::box({1, 2, 0.25}, {3, 3, 0.75}));
    REQUIRE(spots.size() == 1);
    check_box(spots[0], {1, 2, 0.25}, {3, 3, 0.75});
  }
}

TEST_CASE("a bridge meets its ground twice, unless what is nearer than its span counts as one") {
  // Two legs of 1 x 1 that stand 2 apart.
  const Shape bridge =
      solids::extruded_profile({{-2, 1}, {-1, 1}, {-1, 3}, {1, 3}, {1, 1}, {2, 1}, {2, 4}, {-2, 4}}, 1);
  std::vector<PartInterface> spots = spots_of(plate, bridge);
  REQUIRE(spots.size() == 2);
  std::sort(spots.begin(), spots.end(), [](const PartInterface& a, const PartInterface& b) {
    return a.region.centre.x() < b.region.centre.x();
  });
  check_box(spots[0], {-2, 0, 1}, {-1, 1, 1});
  check_box(spots[1], {1, 0, 1}, {2, 1, 1});
  CHECK(spots_of(plate, bridge, {0.1, 1.9}).size() == 2);
  const std::vector<PartInterface> one = spots_of(plate, bridge, {0.1, 2.1});
  REQUIRE(one.size() == 1);
  check_box(one[0], {-2, 0, 1}, {2, 1, 1});
}

TEST_CASE("where two parts meet depends neither on their order nor on their pose") {
  const Shape post = solids::box({1, 4, 0.9}, {3, 7, 6});
  const std::vector<PartInterface> given = spots_of(plate, post), swapped = spots_of(post, plate);
  REQUIRE(given.size() == 1);
  REQUIRE(swapped.size() == 1);
  CHECK((given[0].region.centre - swapped[0].region.centre).norm() < 1e-12);
  CHECK((given[0].region.deviations - swapped[0].region.deviations).norm() < 1e-12);
  for (std::uint64_t seed = 1; seed < 6; ++seed) {
    const Eigen::Matrix3d rotation = solids::random_rotation(seed);
    const Eigen::Vector3d shift(7, -3, 2);
    const std::vector<PartInterface> posed =
        spots_of(transformed(plate, rotation, shift), transformed(post, rotation, shift));
    REQUIRE(posed.size() == 1);
    CHECK(posed[0].gap == 0);
    CHECK((posed[0].region.centre - rotation * given[0].region.centre - shift).norm() < 1e-9);
    CHECK((posed[0].region.deviations - given[0].region.deviations).norm() < 1e-9);
  }
}

TEST_CASE("a part without area is refused by its name") {
  Shape needle = solids::box({0, 0, 1}, {1, 1, 2});
  needle.vertices.leftCols<2>().setZero();
  CHECK(message_of<InputError>([&] { surface(needle); }) == "part 'part' has no triangle of positive area");
}

}  // namespace stackabilization::part_interfaces_test
