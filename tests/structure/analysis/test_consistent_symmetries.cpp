#include <cmath>
#include <numbers>

#include "structure/analysis/consistent_symmetries.h"
#include "structure/model/symmetry_orbit.h"
#include "support/catch.h"
#include "support/variants.h"

namespace stackabilization::consistent_symmetries_test {

using detail::make_consistent;
using std::numbers::pi;

namespace {

constexpr double degree = pi / 180;

Symmetry mirror(const Eigen::Vector3d& normal, const Eigen::Vector3d& point = {0, 0, 0}) {
  return {SymmetryKind::reflection, point, normal.normalized(), 2};
}
Symmetry turn(int order, const Eigen::Vector3d& axis, const Eigen::Vector3d& point = {0, 0, 0}) {
  return {SymmetryKind::rotation, point, axis.normalized(), order};
}
Eigen::Vector3d in_plane(double angle) {
  return {std::cos(angle), std::sin(angle), 0};
}

/// One part, a cube of edge 2 around the origin, in a shape of diagonal 10, with these symmetries of its own.
Structure cube_with(const std::vector<Symmetry>& symmetries) {
  Structure structure;
  structure.diagonal = 10;
  OrientedBox box;
  box.half_extents.setConstant(1);
  structure.parts.push_back({"cube", cuboid_of(box), {}});
  for (const Symmetry& symmetry : symmetries)
    structure.relations.push_back(
        {.type = RelationType::self_symmetry, .parts = {0}, .symmetry = symmetry, .points = {}});
  return structure;
}

std::vector<Symmetry> corrected(const std::vector<Symmetry>& symmetries) {
  Structure structure = cube_with(symmetries);
  make_consistent(structure);
  std::vector<Symmetry> result;
  for (const Relation& relation : structure.relations) result.push_back(relation.symmetry);
  return result;
}

double angle_between(const Symmetry& a, const Symmetry& b) {
  return std::atan2(a.axis.cross(b.axis).norm(), a.axis.dot(b.axis));
}

bool same(const Symmetry& a, const Symmetry& b) {
  return a.kind == b.kind && a.point == b.point && a.axis == b.axis && a.order == b.order;
}

/// Order of the group of the part's symmetries, 0 where they contradict each other.
std::size_t group_order(const std::vector<Symmetry>& symmetries) {
  const detail::OrbitsOrContradiction found = detail::find_orbits(cube_with(symmetries));
  return found.contradiction ? 0 : found.orbits.front().group.size();
}

}  // namespace

TEST_CASE("parallel planes differ by twice their distance") {
  const Primitive cube = cube_with({}).parts[0].primitive;
  for (const double apart : {0.0, 0.25, 3.0})
    CHECK(detail::difference(mirror({0, 0, 1}), mirror({0, 0, 1}, {5, 5, apart}), cube) ==
          Approx(2 * apart).margin(1e-14));
}

TEST_CASE("planes through the middle of a part differ by what they turn its corners and its axes") {
  // Mirrors whose planes meet at an angle differ by a turn of twice that: of the corner at distance sqrt(2)
  // from the common line by the chord, of the axes by 2 sqrt(2) sin(angle), at the distance sqrt(3).
  const Primitive cube = cube_with({}).parts[0].primitive;
  for (const double angle : {0.01, 0.3, 1.0}) {
    const double expected =
        2 * std::sin(angle) * std::sqrt(2.0) + 2 * std::sqrt(2.0) * std::sin(angle) * std::sqrt(3.0);
    CHECK(detail::difference(mirror(in_plane(0.2)), mirror(in_plane(0.2 + angle)), cube) ==
          Approx(expected).epsilon(1e-12));
  }
}

TEST_CASE("a symmetry that does nearly the same as an earlier one becomes that one, others stay") {
  // tolerance::same_symmetry of the diagonal is 0.1; a plane apart by d moves everything by 2 d.
  const Symmetry plane = mirror({1, 0, 0});
  CHECK(same(corrected({plane, mirror({1, 0, 0}, {0.049, 0, 0})})[1], plane));
  CHECK(corrected({plane, mirror({1, 0, 0}, {0.051, 0, 0})})[1].point.x() == 0.051);
  const Symmetry revolution = {SymmetryKind::revolution, {0, 0, 0}, {1, 0, 0}, 2};  // moves as its half turn
  CHECK(corrected({turn(2, {1, 0, 0}), revolution})[1].kind == SymmetryKind::revolution);
  // Turns by 9 and by 8.8 degrees move the corners by less than 0.1 apart, but are not one.
  CHECK(detail::difference(turn(40, {1, 0, 0}), turn(41, {1, 0, 0}), cube_with({}).parts[0].primitive) < 0.1);
  CHECK(corrected({turn(40, {1, 0, 0}), turn(41, {1, 0, 0})})[1].order == 41);
}

TEST_CASE("of the whole shape's symmetries the nearest one is taken") {
  Structure structure = cube_with({mirror({1, 0, 0}, {0.02, 0, 0})});
  structure.symmetries = {mirror({1, 0, 0}, {-0.02, 0, 0}), mirror({1, 0, 0}, {0.03, 0, 0}),
                          mirror({1, 0, 0}, {0.05, 0, 0})};
  make_consistent(structure);
  CHECK(same(structure.relations[0].symmetry, structure.symmetries[1]));
  CHECK(structure.symmetries[1].point.x() == 0.03);
}

TEST_CASE("axes within the tolerance of an axis or a main plane of the file lie in it exactly") {
  const Symmetry nearly = corrected({mirror({1, 0.0009, -0.0009})})[0];
  CHECK(nearly.axis == Eigen::Vector3d::UnitX());
  const Symmetry oblique = corrected({mirror({1, 1, 0.0009})})[0];
  CHECK(oblique.axis.z() == 0);
  CHECK(oblique.axis.norm() == Approx(1).epsilon(1e-15));
  const Eigen::Vector3d off = Eigen::Vector3d(1, 0.0015, 0).normalized();
  CHECK(corrected({mirror(off)})[0].axis == off);
}

TEST_CASE("planes that meet nearly at a multiple of 180 / n degrees, n up to 8, meet at it exactly") {
  const Symmetry first = mirror(in_plane(0.4));
  const auto angle_after = [&](double angle) {
    const std::vector<Symmetry> both = corrected({first, mirror(in_plane(0.4 + angle))});
    CHECK(both[0].axis.isApprox(first.axis, 1e-15));
    return angle_between(both[0], both[1]);
  };
  for (int n = 2; n <= 8; ++n)
    for (int k = 1; k < n; ++k)
      for (const double off : {-0.009, 0.0, 0.009}) {
        INFO(k << " * 180 / " << n << " + " << off);
        CHECK(angle_after(k * pi / n + off) == Approx(k * pi / n).margin(1e-12));
      }
  // Planes far from each other are parallel to the last bit.
  const std::vector<Symmetry> parallel = corrected({first, mirror(-in_plane(0.405), {3, 0, 0})});
  CHECK(parallel[1].axis == -parallel[0].axis);
  CHECK(parallel[1].point == Eigen::Vector3d(3, 0, 0));
  // In the middle between two of them it stays: 51.4 and 60 degrees, 0 and 22.5 degrees.
  for (const double angle : {55.7 * degree, 11 * degree})
    CHECK(angle_after(angle) == Approx(angle).margin(1e-12));
}

TEST_CASE("nearly dihedral mirrors become so, and generate a finite group") {
  solids::Random random(9);
  for (const int n : {2, 3, 4, 5, 6, 8})
    for (int trial = 0; trial < 5; ++trial) {
      INFO(n);
      // All planes of the group, through one line but for a little.
      const Eigen::Matrix3d rotation = solids::random_rotation(static_cast<std::uint64_t>(trial));
      std::vector<Symmetry> planes;
      for (int k = 0; k < n; ++k) {
        const double angle = k * pi / n + (k == 0 ? 0 : 0.002 * random.uniform(-1, 1));
        planes.push_back(mirror(rotation * in_plane(angle), 0.002 * random.in_cube()));
      }
      CHECK(group_order(planes) == 0);
      CHECK(group_order(corrected(planes)) == static_cast<std::size_t>(2 * n));
    }
}

TEST_CASE("an axis of rotation lies in its mirror planes, and across them, exactly") {
  const std::vector<Symmetry> found =
      corrected({mirror({1, 0, 0}), turn(4, {0.005, 0.003, 1}, {0.05, 0.7, 0})});
  CHECK(found[1].axis.x() == Approx(0).margin(1e-16));
  CHECK(found[1].point.x() == Approx(0).margin(1e-16));
  CHECK(found[1].point.y() == 0.7);  // along the plane nothing is known
  CHECK(group_order(found) == 8);

  // Of a plane across an axis the direction is corrected, and a plane along an axis goes through it.
  const std::vector<Symmetry> along =
      corrected({turn(4, {0, 0, 1}, {1, 2, 0}), mirror({1, 0, 0.008}, {1.04, 0, 0})});
  CHECK(along[1].axis.dot(along[0].axis) == Approx(0).margin(1e-16));
  CHECK(along[1].axis.dot(along[1].point - along[0].point) == Approx(0).margin(1e-15));
}

TEST_CASE("a plane is put across all that it is nearly across, of which some may be parallel") {
  const std::vector<Symmetry> found = corrected(
      {mirror({1, 0, 0}), mirror({1, 0, 0}, {3, 0, 0}), mirror({0, 1, 0}), mirror({0.005, -0.005, 1})});
  CHECK((found[3].axis - Eigen::Vector3d::UnitZ()).norm() < 1e-15);
}

TEST_CASE("what is farther apart stays as it is") {
  const std::vector<Symmetry> given = {mirror({1, 0, 0}), turn(4, {0, 0.6, 0.8}, {0.2, 0.7, 0}),
                                       mirror({1, 2, 3}, {3, 0, 0})};
  const std::vector<Symmetry> found = corrected(given);
  CHECK(same(found[0], given[0]));
  CHECK(found[1].point == given[1].point);  // 0.2 is more than 0.1 off the plane
  CHECK(found[2].point == given[2].point);
  CHECK(found[2].axis.isApprox(given[2].axis, 1e-15));
}

TEST_CASE("symmetries of parts that no relation ties together do not bear on each other") {
  Structure structure = cube_with({mirror(in_plane(0.4)), mirror(in_plane(0.4 + pi / 2 + 0.005))});
  structure.parts.push_back(structure.parts[0]);
  structure.relations[1].parts = {1};
  const Eigen::Vector3d before = structure.relations[1].symmetry.axis;
  make_consistent(structure);
  CHECK(structure.relations[1].symmetry.axis.isApprox(before, 1e-15));

  structure.relations.push_back(
      {.type = RelationType::symmetry, .parts = {0, 1}, .symmetry = turn(2, {0, 0, 1}), .points = {}});
  make_consistent(structure);
  CHECK(angle_between(structure.relations[0].symmetry, structure.relations[1].symmetry) ==
        Approx(pi / 2).epsilon(1e-14));
}

TEST_CASE("what is consistent stays so") {
  solids::Random random(13);
  std::vector<Symmetry> symmetries;
  for (int k = 0; k < 4; ++k)
    symmetries.push_back(
        mirror(in_plane(0.2 + k * pi / 4 + 0.003 * random.uniform()), 0.01 * random.in_cube()));
  const std::vector<Symmetry> once = corrected(symmetries), twice = corrected(once);
  for (std::size_t k = 0; k < once.size(); ++k) {
    CHECK(twice[k].axis.isApprox(once[k].axis, 1e-14));
    CHECK((twice[k].point - once[k].point).norm() < 1e-14);
  }
}

}  // namespace stackabilization::consistent_symmetries_test
