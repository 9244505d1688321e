#include <cmath>
#include <numbers>

#include "stackabilization/core/errors.h"
#include "stackabilization/structure/structure.h"
#include "support/catch.h"

using namespace stackabilization;

namespace {

OrientedBox tilted_box() {
  OrientedBox box;
  box.centre = {3, -1, 2};
  box.axes = Eigen::AngleAxisd(0.7, Eigen::Vector3d(1, 2, -1).normalized()).toRotationMatrix();
  box.half_extents = {1, 2, 0.5};
  return box;
}

GeneralizedCylinder ring(int sections, double radius, double thickness) {
  GeneralizedCylinder cylinder{Points(sections, 3),
                               Eigen::VectorXd::Constant(sections, thickness),
                               {},
                               true,
                               Eigen::Quaterniond::Identity()};
  for (int k = 0; k < sections; ++k) {
    const double angle = 2 * std::numbers::pi * k / sections;
    cylinder.centres.row(k) << radius * std::cos(angle), radius * std::sin(angle), 1;
  }
  return cylinder;
}

}  // namespace

TEST_CASE("a cuboid's faces are seen counter-clockwise from outside, and it has the box's volume") {
  const OrientedBox box = tilted_box();
  const Cuboid cuboid = cuboid_of(box);
  CHECK(volume(cuboid) == Approx(box.volume()).epsilon(1e-13));
  for (int face = 0; face < 6; ++face) {
    const auto ring = cuboid_face(face);
    const Eigen::Vector3d a = cuboid.corners.row(ring[0]), b = cuboid.corners.row(ring[1]),
                          c = cuboid.corners.row(ring[2]);
    const Eigen::Vector3d outward = (face % 2 == 1 ? 1 : -1) * box.axes.col(face / 2);
    CHECK((b - a).cross(c - b).normalized().dot(outward) == Approx(1));
  }
}

TEST_CASE("the volume of a sheared and tapered cuboid is that of the frustum") {
  Cuboid cuboid = cuboid_of({Eigen::Vector3d::Zero(), Eigen::Matrix3d::Identity(), Eigen::Vector3d::Ones()});
  for (const int k : cuboid_face(5))
    cuboid.corners.row(k) = cuboid.corners.row(k).cwiseProduct(Eigen::RowVector3d(0.5, 0.5, 1));
  CHECK(volume(cuboid) == Approx(2.0 / 3 * (4 + 1 + 2)));  // h / 3 (A + B + sqrt(A B))
  for (const int k : cuboid_face(5)) cuboid.corners.row(k) += Eigen::RowVector3d(3, -1, 0);
  CHECK(volume(cuboid) == Approx(2.0 / 3 * (4 + 1 + 2)));
}

TEST_CASE("tangents, arc lengths and volume of a closed cylinder are those of the polygon") {
  const GeneralizedCylinder cylinder = ring(12, 2, 0.25);
  const double side = 4 * std::sin(std::numbers::pi / 12);
  CHECK(section_arc_lengths(cylinder).size() == 13);
  CHECK(section_arc_lengths(cylinder)(12) == Approx(12 * side));
  CHECK(volume(cylinder) == Approx(std::numbers::pi * 0.0625 * 12 * side));
  const Points tangents = section_tangents(cylinder);
  for (int k = 0; k < 12; ++k)
    CHECK(tangents.row(k).dot(cylinder.centres.row(k) - Eigen::RowVector3d(0, 0, 1)) ==
          Approx(0).margin(1e-14));
}

TEST_CASE("an open cylinder's volume is the sum of its frusta, and its end tangents are one-sided") {
  GeneralizedCylinder cone{
      Points(3, 3), Eigen::Vector3d(1, 0.75, 0.5), {}, false, Eigen::Quaterniond::Identity()};
  cone.centres << 0, 0, 0, 0, 0, 1, 0, 0, 2;
  CHECK(volume(cone) == Approx(std::numbers::pi * 2 / 3 * (1 + 0.25 + 0.5)));
  CHECK(section_tangents(cone).row(0) == Eigen::RowVector3d(0, 0, 1));
  CHECK(section_arc_lengths(cone) == Eigen::Vector3d(0, 1, 2));
}

TEST_CASE("symmetry maps are involutions, rotations of their order, and the bisector swaps its points") {
  const Eigen::Vector3d a(1, 2, 3), b(-2, 0.5, 4);
  const Eigen::Isometry3d mirror = isometry_of(bisector(a, b));
  CHECK((mirror * a - b).norm() == Approx(0).margin(1e-14));
  CHECK((mirror * (mirror * b) - b).norm() == Approx(0).margin(1e-14));
  const Symmetry fifth{SymmetryKind::rotation, a, Eigen::Vector3d(1, 1, 0).normalized(), 5};
  Eigen::Vector3d p = b;
  for (int k = 0; k < 5; ++k) p = isometry_of(fifth) * p;
  CHECK((p - b).norm() == Approx(0).margin(1e-13));
  CHECK((isometry_of(fifth) * b - b).norm() > 0.1);
  const Symmetry body{SymmetryKind::revolution, a, Eigen::Vector3d::UnitZ(), 2};
  CHECK((isometry_of(body) * Eigen::Vector3d(1, 2, -7) - Eigen::Vector3d(1, 2, -7)).norm() ==
        Approx(0).margin(1e-14));
}

TEST_CASE("primitives with impossible numbers are refused in words") {
  GeneralizedCylinder cylinder = ring(5, 1, 0.1);
  CHECK_NOTHROW(validate(Primitive(cylinder), "rim"));
  cylinder.radii(2) = 0;
  CHECK_THROWS_AS(validate(Primitive(cylinder), "rim"), InputError);
  cylinder = ring(5, 1, 0.1);
  cylinder.centres.row(0) = cylinder.centres.row(4);
  CHECK_THROWS_AS(validate(Primitive(cylinder), "rim"), InputError);
  Cuboid cuboid = cuboid_of(tilted_box());
  cuboid.corners(3, 1) = NAN;
  CHECK_THROWS_AS(validate(Primitive(cuboid), "seat"), InputError);
}
