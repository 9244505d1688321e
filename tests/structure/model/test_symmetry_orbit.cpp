#include <cmath>
#include <numbers>

#include "structure/model/symmetry_orbit.h"
#include "support/catch.h"
#include "support/messages.h"
#include "support/variants.h"

namespace stackabilization::symmetry_orbit_test {

using detail::find_orbits;
using detail::Orbit;
using detail::OrbitsOrContradiction;
using std::numbers::pi;

namespace {

/// Parts p0, p1, ... that are points at the origin in a shape of diagonal 10: maps are compared there.
Structure parts(int count) {
  Structure structure;
  structure.diagonal = 10;
  for (int k = 0; k < count; ++k) structure.parts.push_back({"p" + std::to_string(k), cuboid_of({}), {}});
  return structure;
}

Symmetry mirror(const Eigen::Vector3d& normal, const Eigen::Vector3d& point = {0, 0, 0}) {
  return {SymmetryKind::reflection, point, normal.normalized(), 2};
}
Symmetry turn(int order, const Eigen::Vector3d& axis = {0, 0, 1}, const Eigen::Vector3d& point = {0, 0, 0}) {
  return {SymmetryKind::rotation, point, axis.normalized(), order};
}

Relation self(int part, const Symmetry& symmetry) {
  return {.type = RelationType::self_symmetry, .parts = {part}, .symmetry = symmetry, .points = {}};
}
Relation pair(int a, int b, const Symmetry& symmetry) {
  return {.type = RelationType::symmetry, .parts = {a, b}, .symmetry = symmetry, .points = {}};
}

OrbitsOrContradiction orbits_of(int count, const std::vector<Relation>& relations) {
  Structure structure = parts(count);
  structure.relations = relations;
  return find_orbits(structure);
}

/// Order of the group that symmetries of one part generate; 0 where they contradict each other.
std::size_t group_order(const std::vector<Symmetry>& symmetries) {
  std::vector<Relation> relations;
  for (const Symmetry& symmetry : symmetries) relations.push_back(self(0, symmetry));
  const OrbitsOrContradiction found = orbits_of(1, relations);
  REQUIRE(found.orbits.size() == 1);
  return found.contradiction ? 0 : found.orbits[0].group.size();
}

Eigen::Vector3d in_plane(double angle) {
  return {std::cos(angle), std::sin(angle), 0};
}

/// Normals of mirror planes that generate the symmetry group of the icosahedron: neighbours meet at 36, 60
/// and 90 degrees.
std::vector<Symmetry> icosahedral_mirrors() {
  const Eigen::Vector3d a(1, 0, 0), c(0, 1, 0);
  const double x = -std::cos(pi / 5), y = -std::cos(pi / 3);
  return {mirror(a), mirror({x, y, std::sqrt(1 - x * x - y * y)}), mirror(c)};
}

/// Is the group closed, with inverses, and no member in it twice?
void check_group(const Orbit& orbit) {
  const auto row_of = [&](const Eigen::Isometry3d& map) {
    int found = 0;
    for (const Eigen::Isometry3d& member : orbit.group) found += member.isApprox(map, 1e-9) ? 1 : 0;
    return found;
  };
  CHECK(orbit.group.front().matrix() == Eigen::Isometry3d::Identity().matrix());
  for (const Eigen::Isometry3d& a : orbit.group) {
    CHECK(row_of(a.inverse()) == 1);
    for (const Eigen::Isometry3d& b : orbit.group) REQUIRE(row_of(a * b) == 1);
  }
}

}  // namespace

TEST_CASE("the parts of a ring are one orbit, reached by the powers of its turn") {
  constexpr int n = 7;
  std::vector<Relation> relations;
  for (int k = 0; k < n; ++k) relations.push_back(pair(k, (k + 1) % n, turn(n, {0, 0, 1}, {3, 1, 0})));
  const OrbitsOrContradiction found = orbits_of(n, relations);
  CHECK_FALSE(found.contradiction);
  REQUIRE(found.orbits.size() == 1);
  const Orbit& orbit = found.orbits[0];
  // Breadth first, both ways around.
  CHECK(orbit.parts == std::vector<int>{0, 1, 6, 2, 5, 3, 4});
  for (std::size_t k = 0; k < orbit.parts.size(); ++k) {
    const Eigen::Isometry3d power = Eigen::Translation3d(3, 1, 0) *
                                    Eigen::AngleAxisd(2 * pi * orbit.parts[k] / n, Eigen::Vector3d::UnitZ()) *
                                    Eigen::Translation3d(-3, -1, 0);
    CHECK(orbit.from_first[k].isApprox(power, 1e-13));
  }
  CHECK(orbit.group.size() == 1);  // once around is the identity
}

TEST_CASE("a relation says the same from either of its parts") {
  const Symmetry third = turn(3, {1, 2, 3}, {1, 0, 0});
  Symmetry back = third;
  back.axis = -back.axis;
  const OrbitsOrContradiction forth = orbits_of(2, {pair(0, 1, third)}),
                              reverse = orbits_of(2, {pair(1, 0, back)});
  REQUIRE(forth.orbits.size() == 1);
  REQUIRE(reverse.orbits.size() == 1);
  CHECK(forth.orbits[0].parts == reverse.orbits[0].parts);
  CHECK(forth.orbits[0].from_first[1].isApprox(reverse.orbits[0].from_first[1], 1e-14));
}

TEST_CASE("parts without symmetry have no orbit, others one each") {
  const OrbitsOrContradiction found = orbits_of(
      5,
      {pair(3, 1, mirror({1, 0, 0})),
       self(4, turn(2)),
       {.type = RelationType::point_joint, .parts = {0, 1}, .symmetry = {}, .points = Points::Zero(1, 3)}});
  REQUIRE(found.orbits.size() == 2);
  CHECK(found.orbits[0].parts == std::vector<int>{1, 3});
  CHECK(found.orbits[1].parts == std::vector<int>{4});
  CHECK(orbits_of(3, {}).orbits.empty());
}

TEST_CASE("the symmetries of a part generate the groups of the textbook") {
  CHECK(group_order({mirror({1, 0, 0})}) == 2);
  CHECK(group_order({mirror({1, 0, 0}), mirror({0, 1, 0})}) == 4);
  CHECK(group_order({mirror({1, 0, 0}), mirror({0, 1, 0}), mirror({0, 0, 1})}) == 8);
  CHECK(group_order({turn(5)}) == 5);
  CHECK(group_order({turn(5), turn(2, {1, 0, 0})}) == 10);
  CHECK(group_order({turn(5), turn(2, {1, 0, 0}), mirror({0, 0, 1})}) == 20);
  CHECK(group_order({turn(3, {1, 1, 1}), turn(2)}) == 12);  // of the tetrahedron
  CHECK(group_order({turn(3, {1, 1, 1}), turn(4)}) == 24);  // turns of the cube
  CHECK(group_order({mirror({1, -1, 0}), mirror({0, 1, -1}), mirror({0, 0, 1})}) == 48);  // and its mirrors
  CHECK(group_order(icosahedral_mirrors()) == 120);
  // Of a revolution no more than the half turn is taken.
  CHECK(group_order({{SymmetryKind::revolution, {0, 0, 0}, {0, 0, 1}, 2}}) == 2);
}

TEST_CASE("two mirror planes at 180 / n degrees generate 2 n isometries, up to what any body has") {
  for (const int n : {2, 3, 4, 5, 6, 8, 12, 60}) {
    INFO(n);
    CHECK(group_order({mirror(in_plane(0.3)), mirror(in_plane(0.3 + pi / n))}) ==
          static_cast<std::size_t>(2 * n));
  }
  CHECK(group_order({mirror(in_plane(0)), mirror(in_plane(pi / 61))}) == 0);
  CHECK(group_order({mirror(in_plane(0)), mirror(in_plane(1))}) == 0);  // no part of a full turn
}

TEST_CASE("what is generated is a group, in any pose") {
  solids::Random random(3);
  for (int trial = 0; trial < 5; ++trial) {
    const Eigen::Matrix3d rotation = solids::random_rotation(static_cast<std::uint64_t>(trial));
    const Eigen::Vector3d point = 3 * random.in_cube();
    std::vector<Relation> relations;
    for (const Eigen::Vector3d& normal :
         {Eigen::Vector3d(1, -1, 0), Eigen::Vector3d(0, 1, -1), Eigen::Vector3d(0, 0, 1)})
      relations.push_back(self(0, mirror(rotation * normal, point)));
    const OrbitsOrContradiction found = orbits_of(1, relations);
    CHECK_FALSE(found.contradiction);
    REQUIRE(found.orbits[0].group.size() == 48);
    check_group(found.orbits[0]);
  }
}

TEST_CASE("a loop of pairs adds what it does to the first part") {
  // 0 -> 1 by the mirror x, 1 -> 2 by the mirror y, 2 -> 0 by the mirror x: the mirror y is left over.
  const Symmetry x = mirror({1, 0, 0}), y = mirror({0, 1, 0});
  const OrbitsOrContradiction found = orbits_of(3, {pair(0, 1, x), pair(1, 2, y), pair(2, 0, x)});
  CHECK_FALSE(found.contradiction);
  REQUIRE(found.orbits.size() == 1);
  REQUIRE(found.orbits[0].group.size() == 2);
  CHECK(found.orbits[0].group[1].isApprox(isometry_of(y), 1e-14));

  // A symmetry of the last part to itself, told of the first.
  const OrbitsOrContradiction carried = orbits_of(2, {pair(0, 1, turn(4)), self(1, x)});
  REQUIRE(carried.orbits[0].group.size() == 2);
  CHECK(carried.orbits[0].group[1].isApprox(isometry_of(y), 1e-14));
}

TEST_CASE("planes apart contradict each other, however little, down to the tolerance") {
  // Their product moves everything by twice their distance; tolerance::relative of the diagonal is 1e-8.
  for (const double apart : {1.0, 1e-3, 1e-6, 6e-9})
    CHECK(group_order({mirror({1, 0, 0}), mirror({1, 0, 0}, {apart, 0, 0})}) == 0);
  CHECK(group_order({mirror({1, 0, 0}), mirror({1, 0, 0}, {4e-9, 0, 0})}) == 2);
}

TEST_CASE("a contradiction names the relations of its orbit, and of every orbit the one to do without") {
  const Symmetry x = mirror({1, 0, 0}), far = mirror({1, 0, 0}, {1, 0, 0});
  const OrbitsOrContradiction found = orbits_of(7, {pair(0, 1, x), pair(0, 1, far), self(2, x), self(3, x),
                                                    self(3, far), self(4, mirror({0, 1, 0})), pair(5, 6, x)});
  REQUIRE(found.contradiction);
  CHECK(found.contradiction->relations == std::vector<int>{0, 1});
  CHECK(found.contradiction->dispensable == std::vector<int>{1, 4});
  CHECK(mentions(found.contradiction->reason, "relation 0 (symmetry of 'p0' and 'p1') and relation 1"));
  CHECK(found.orbits.size() == 5);

  // Without them nothing contradicts.
  CHECK_FALSE(
      orbits_of(5, {pair(0, 1, x), self(2, x), self(3, x), self(4, mirror({0, 1, 0}))}).contradiction);
}

}  // namespace stackabilization::symmetry_orbit_test
