#include <algorithm>
#include <numbers>

#include "stackabilization/structure/symmetry.h"
#include "structure/model/correspondence.h"
#include "structure/model/nearest_box.h"
#include "support/catch.h"
#include "support/variants.h"

using namespace stackabilization;

namespace {

OrientedBox turned_box(const Eigen::Vector3d& half_extents) {
  OrientedBox box;
  box.centre = {3, -2, 7};
  box.axes = Eigen::AngleAxisd(0.7, Eigen::Vector3d(1, 2, -1).normalized()).toRotationMatrix();
  box.half_extents = half_extents;
  return box;
}

GeneralizedCylinder curve(int count, bool closed) {
  GeneralizedCylinder cylinder;
  cylinder.centres.resize(count, 3);
  cylinder.radii.setLinSpaced(count, 1, 2);
  cylinder.closed = closed;
  for (int k = 0; k < count; ++k) {
    const double angle = 2 * std::numbers::pi * k / count;
    cylinder.centres.row(k) << 4 * std::cos(angle), 3 * std::sin(angle),
        std::cos(2 * angle) + 0.3 * std::sin(angle);
  }
  return cylinder;
}

Points mapped_points(const Primitive& primitive, const Eigen::Isometry3d& map) {
  return (control_points(primitive) * map.linear().transpose()).rowwise() + map.translation().transpose();
}

}  // namespace

TEST_CASE("corners of a moved and relabelled box find their images") {
  solids::Random random(5);
  const Cuboid box = cuboid_of(turned_box({1, 2, 3}));
  for (int round = 0; round < 50; ++round) {
    Eigen::Isometry3d map = Eigen::Isometry3d::Identity();
    map.rotate(Eigen::AngleAxisd(random.uniform(-3, 3), random.on_sphere())).translate(10 * random.in_cube());
    if (round % 2 == 0) map = map * isometry_of({.axis = random.on_sphere()});
    // The image with its axes in another order, one of them turned around.
    OrientedBox other = nearest_box(box);
    other.centre = map * other.centre;
    other.axes = (map.linear() * other.axes).eval();
    other.axes = (Eigen::Matrix3d() << other.axes.col(2), -other.axes.col(0), other.axes.col(1)).finished();
    other.half_extents = Eigen::Vector3d(3, 1, 2);
    const Primitive image = cuboid_of(other);
    const std::vector<int> to = control_correspondence(box, image, map);
    REQUIRE(to.size() == 8);
    const Points wanted = mapped_points(box, map), found = control_points(image);
    for (int k = 0; k < 8; ++k)
      CHECK((wanted.row(k) - found.row(to[static_cast<std::size_t>(k)])).norm() < 1e-12);
  }
}

TEST_CASE("every box assignment is a bijection that keeps edges edges") {
  solids::Random random(9);
  for (int round = 0; round < 30; ++round) {
    Cuboid a, b;
    for (Cuboid* one : {&a, &b})
      for (int k = 0; k < 8; ++k) one->corners.row(k) = random.in_cube().transpose();
    const std::vector<int> to = control_correspondence(a, b, Eigen::Isometry3d::Identity());
    std::vector<int> sorted = to;
    std::sort(sorted.begin(), sorted.end());
    for (int k = 0; k < 8; ++k) {
      CHECK(sorted[static_cast<std::size_t>(k)] == k);
      for (int bit = 1; bit < 8; bit *= 2) {
        const int changed = to[static_cast<std::size_t>(k)] ^ to[static_cast<std::size_t>(k ^ bit)];
        CHECK((changed == 1 || changed == 2 || changed == 4));
      }
    }
  }
}

TEST_CASE("flat boxes and cubes do not turn over by rounding") {
  for (const Eigen::Vector3d& half : {Eigen::Vector3d(1, 2, 0), Eigen::Vector3d(0, 0, 0)}) {
    const Cuboid box = cuboid_of(turned_box(half));
    CHECK(control_correspondence(box, box, Eigen::Isometry3d::Identity()) ==
          std::vector<int>{0, 1, 2, 3, 4, 5, 6, 7});
  }
}

TEST_CASE("curves are matched both ways, closed ones from every start") {
  solids::Random random(3);
  for (const bool closed : {false, true})
    for (int shift = 0; shift < (closed ? 7 : 1); ++shift)
      for (const bool reversed : {false, true}) {
        const GeneralizedCylinder a = curve(7, closed);
        Eigen::Isometry3d map = isometry_of({.point = random.in_cube(), .axis = random.on_sphere()});
        GeneralizedCylinder b = a;
        const Points image = mapped_points(a, map);
        std::vector<int> wanted(7);
        for (int k = 0; k < 7; ++k) {
          wanted[static_cast<std::size_t>(k)] = reversed ? (13 - k - shift) % 7 : (k + shift) % 7;
          b.centres.row(wanted[static_cast<std::size_t>(k)]) = image.row(k);
        }
        CHECK(control_correspondence(a, b, map) == wanted);
      }
}

TEST_CASE("primitives of different kinds or sizes have no correspondence") {
  const Eigen::Isometry3d same = Eigen::Isometry3d::Identity();
  CHECK(control_correspondence(cuboid_of({}), curve(8, false), same).empty());
  CHECK(control_correspondence(curve(7, false), curve(8, false), same).empty());
  CHECK(control_correspondence(curve(8, true), curve(8, false), same).empty());
}

TEST_CASE("the nearest box of a box is that box, also mirrored, flat or a single point") {
  for (const Eigen::Vector3d& half : {Eigen::Vector3d(1, 2, 3), Eigen::Vector3d(1, 0, 3),
                                      Eigen::Vector3d(0, 2, 0), Eigen::Vector3d(0, 0, 0)}) {
    Cuboid cuboid = cuboid_of(turned_box(half));
    CHECK(is_box(cuboid));
    cuboid.corners.col(0) *= -1;
    CHECK(is_box(cuboid));
    CHECK((cuboid_of(nearest_box(cuboid)).corners - cuboid.corners).norm() < 1e-13);
  }
  Cuboid sheared = cuboid_of(turned_box({1, 2, 3}));
  sheared.corners(0, 0) += 0.1;
  CHECK(!is_box(sheared));
}
