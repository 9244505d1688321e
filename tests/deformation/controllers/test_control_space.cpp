#include <algorithm>
#include <cmath>
#include <numbers>

#include "deformation/controllers/control_space.h"
#include "stackabilization/core/errors.h"
#include "stackabilization/deformation/relation_residual.h"
#include "support/catch.h"
#include "support/messages.h"
#include "support/structures.h"
#include "support/variants.h"

namespace stackabilization::control_space_test {

using namespace detail;

namespace {

Symmetry mirror(const Eigen::Vector3d& normal) {
  return {SymmetryKind::reflection, {0, 0, 0}, normal.normalized(), 2};
}

/// Three boxes around the z axis, the first reached from the second by a third of a turn back.
Structure ring() {
  Structure structure;
  structure.diagonal = 10;
  for (int k = 0; k < 3; ++k) {
    const Eigen::Matrix3d turned =
        Eigen::AngleAxisd(2 * std::numbers::pi * k / 3, Eigen::Vector3d::UnitZ()).toRotationMatrix();
    structure.parts.push_back({"box_" + std::to_string(k),
                               cuboid_of({turned * Eigen::Vector3d(3, 0, 0), turned, {1, 0.5, 2}}),
                               {}});
  }
  for (const int other : {0, 2}) {
    const Eigen::Vector3d axis(0, 0, other == 0 ? -1 : 1);
    structure.relations.push_back({.type = RelationType::symmetry,
                                   .parts = {1, other},
                                   .symmetry = {SymmetryKind::rotation, {0, 0, 0}, axis, 3},
                                   .points = {}});
  }
  // The last box is its own mirror image, which is told of the first.
  const double angle = 4 * std::numbers::pi / 3;
  structure.relations.push_back({.type = RelationType::self_symmetry,
                                 .parts = {2},
                                 .symmetry = mirror({-std::sin(angle), std::cos(angle), 0}),
                                 .points = {}});
  // The axes of the first box in another order, so that corners are not mapped one to one in either way.
  auto& corners = std::get<Cuboid>(structure.parts[0].primitive).corners;
  const Cuboid given = std::get<Cuboid>(structure.parts[0].primitive);
  for (int k = 0; k < 8; ++k)  // a quarter turn of the frame about z: x -> y -> -x
    corners.row(k) = given.corners.row((k & 4) | ((k & 1) << 1) | ((k & 2) ? 0 : 1));
  return structure;
}

std::vector<Structure> structures_with_symmetry() {
  return {ring(), structures::table().structure, structures::rough_stool().structure,
          structures::mug().structure, structures::post_with_ring().structure};
}

/// One part with symmetries of its own.
Structure alone(const Primitive& primitive, const std::vector<Symmetry>& symmetries) {
  Structure structure;
  structure.diagonal = 10;
  structure.parts.push_back({"part", primitive, {}});
  for (const Symmetry& symmetry : symmetries)
    structure.relations.push_back(
        {.type = RelationType::self_symmetry, .parts = {0}, .symmetry = symmetry, .points = {}});
  return structure;
}

Structure cube_with(const std::vector<Symmetry>& symmetries) {
  return alone(cuboid_of({{0, 0, 0}, Eigen::Matrix3d::Identity(), {1, 1, 1}}), symmetries);
}

Symmetry turn(int order, const Eigen::Vector3d& axis) {
  return {SymmetryKind::rotation, {0, 0, 0}, axis.normalized(), order};
}

const Eigen::Vector3d x = Eigen::Vector3d::UnitX(), y = Eigen::Vector3d::UnitY(),
                      z = Eigen::Vector3d::UnitZ();

Eigen::Index control_count(const ControlSpace& space, int of_class) {
  const Primitive& first = space.rest(space.members(of_class).front());
  const Eigen::Index n = control_points(first).rows();
  return std::holds_alternative<Cuboid>(first) ? 3 * n : 4 * n;
}

Eigen::MatrixXd projector(const ControlSpace& space, int of_class) {
  const Eigen::Index size = control_count(space, of_class);
  return space.invariant_columns(of_class, Eigen::MatrixXd::Identity(size, size));
}

/// Dimension of the invariant subspace of the first class.
double freedoms(const Structure& structure) {
  return projector(ControlSpace(structure), 0).trace();
}

ControlState random_state(const ControlSpace& space, int of_class, solids::Random& random) {
  ControlState state;
  state.values.resize(control_count(space, of_class));
  for (double& value : state.values) value = random.uniform(-0.1, 0.1);
  if (std::holds_alternative<GeneralizedCylinder>(space.rest(space.members(of_class).front())))
    state.rotation = Eigen::Quaterniond(Eigen::AngleAxisd(random.uniform(0, 1), random.on_sphere()));
  return state;
}

/// Displacements of the corners of the cube after a symmetry of it, found from where its corners go.
Eigen::VectorXd carried(const Eigen::VectorXd& values, const Structure& structure,
                        const Eigen::Matrix3d& map) {
  const Points corners = control_points(structure.parts[0].primitive);
  Eigen::VectorXd result(values.size());
  for (Eigen::Index i = 0; i < corners.rows(); ++i) {
    const Eigen::RowVector3d image = (map * corners.row(i).transpose()).transpose();
    Eigen::Index j = 0;
    (corners.rowwise() - image).rowwise().norm().minCoeff(&j);
    result.segment<3>(3 * j) = map * values.segment<3>(3 * i);
  }
  return result;
}

}  // namespace

TEST_CASE("classes are the orbits of the parts, the least part first") {
  const ControlSpace space(structures::table().structure);
  REQUIRE(space.class_count() == 4);
  CHECK(space.members(0) == std::vector<int>{0});
  CHECK(space.members(1) == std::vector<int>{1, 2, 3, 4});
  CHECK(space.members(2) == std::vector<int>{5, 7});
  CHECK(space.members(3) == std::vector<int>{6, 8});
  for (int part = 0; part < 9; ++part) {
    const std::vector<int>& members = space.members(space.class_of(part));
    CHECK(std::find(members.begin(), members.end(), part) != members.end());
  }
}

TEST_CASE("the invariant subspace has as many dimensions as points and planes leave") {
  // A group without fixed corners leaves 24 / its order to the corners of a cube.
  CHECK(freedoms(cube_with({})) == 24);
  CHECK(freedoms(cube_with({mirror(x)})) == Approx(12).epsilon(1e-12));
  CHECK(freedoms(cube_with({mirror(x), mirror(y)})) == Approx(6).epsilon(1e-12));
  CHECK(freedoms(cube_with({mirror(x), mirror(y), mirror(z)})) == Approx(3).epsilon(1e-12));
  CHECK(freedoms(cube_with({turn(4, z)})) == Approx(6).epsilon(1e-12));
  // Two corners on the axis keep their way along it, the six others are two orbits.
  CHECK(freedoms(cube_with({turn(3, {1, 1, 1})})) == Approx(8).epsilon(1e-12));
  // All mirrors of the cube leave its size.
  CHECK(freedoms(cube_with({mirror({1, -1, 0}), mirror({0, 1, -1}), mirror(z)})) == Approx(1).epsilon(1e-12));

  // In a mirror plane a centre keeps two ways to go, and its radius; on an axis of turns one.
  const Primitive even = structures::straight_cylinder(-2 * x, 2 * x, 0.5, 6),
                  odd = structures::straight_cylinder(-2 * x, 2 * x, 0.5, 7);
  CHECK(freedoms(alone(even, {mirror(y)})) == Approx(3 * 6).epsilon(1e-12));
  CHECK(freedoms(alone(even, {turn(5, x)})) == Approx(2 * 6).epsilon(1e-12));
  CHECK(freedoms(alone(even, {mirror(x)})) == Approx(2 * 6).epsilon(1e-12));
  CHECK(freedoms(alone(odd, {mirror(x)})) == Approx(4 * 3 + 3).epsilon(1e-12));
}

TEST_CASE("projectors are orthogonal") {
  for (const Structure& structure : structures_with_symmetry()) {
    const ControlSpace space(structure);
    for (int c = 0; c < space.class_count(); ++c) {
      const Eigen::MatrixXd p = projector(space, c);
      CHECK((p * p - p).norm() < 1e-12);
      CHECK((p - p.transpose()).norm() < 1e-12);
    }
  }
}

TEST_CASE("the projection is the mean over the group") {
  const Structure structure = cube_with({mirror({1, -1, 0}), mirror(z)});
  const Eigen::Matrix3d a = isometry_of(structure.relations[0].symmetry).linear(),
                        b = isometry_of(structure.relations[1].symmetry).linear();
  const ControlSpace space(structure);
  solids::Random random(5);
  for (int trial = 0; trial < 10; ++trial) {
    const ControlState state = random_state(space, 0, random);
    Eigen::VectorXd mean = Eigen::VectorXd::Zero(24);
    for (const Eigen::Matrix3d& map :
         {Eigen::Matrix3d(Eigen::Matrix3d::Identity()), a, b, Eigen::Matrix3d(a * b)})
      mean += carried(state.values, structure, map) / 4;
    CHECK((space.invariant(0, state).values - mean).norm() < 1e-13);
  }
}

TEST_CASE("of a rotation the part about the normal of the mirror plane is left, or about the axis") {
  const Primitive tube = structures::straight_cylinder(-2 * x, 2 * x, 0.5, 6);
  ControlState state;
  state.values = Eigen::VectorXd::Zero(24);
  const Eigen::Vector3d vector(0.3, -0.4, 0.5);
  state.rotation = Eigen::Quaterniond(Eigen::AngleAxisd(vector.norm(), vector.normalized()));
  const auto left = [&](const std::vector<Symmetry>& symmetries) {
    const Eigen::AngleAxisd turned(ControlSpace(alone(tube, symmetries)).invariant(0, state).rotation);
    return Eigen::Vector3d(turned.angle() * turned.axis());
  };
  CHECK((left({}) - vector).norm() < 1e-14);
  CHECK((left({mirror(y)}) - Eigen::Vector3d(0, -0.4, 0)).norm() < 1e-14);
  CHECK((left({turn(3, x)}) - Eigen::Vector3d(0.3, 0, 0)).norm() < 1e-14);
  CHECK(left({mirror(y), mirror(z)}).norm() < 1e-14);
}

TEST_CASE("primitives of invariant states are symmetric, whatever the states are") {
  solids::Random random(7);
  for (const Structure& structure : structures_with_symmetry()) {
    const ControlSpace space(structure);
    std::vector<ControlState> states;
    for (int c = 0; c < space.class_count(); ++c)
      states.push_back(space.invariant(c, random_state(space, c, random)));
    const std::vector<Primitive> now = space.primitives(states);
    const std::vector<double> residuals = relation_residuals(structure, now);
    for (std::size_t r = 0; r < residuals.size(); ++r)
      if (structure.relations[r].type == RelationType::symmetry ||
          structure.relations[r].type == RelationType::self_symmetry)
        CHECK(residuals[r] < 1e-13);
    // The states are those of the primitives, projected once more to themselves.
    const std::vector<ControlState> back = space.states(now);
    for (std::size_t c = 0; c < states.size(); ++c) {
      CHECK((back[c].values - states[c].values).norm() < 1e-12);
      CHECK(back[c].rotation.angularDistance(states[c].rotation) < 1e-7);
    }
  }
}

TEST_CASE("every part tells the state of its class, and rest is kept to the last bit") {
  solids::Random random(11);
  for (const Structure& structure : structures_with_symmetry()) {
    const ControlSpace space(structure);
    for (int part = 0; part < static_cast<int>(structure.parts.size()); ++part) {
      const int c = space.class_of(part);
      const ControlState state = random_state(space, c, random);
      const ControlState back = space.state_of(part, space.primitive(part, state));
      CHECK((back.values - state.values).norm() < 1e-13);
      CHECK(back.rotation.angularDistance(state.rotation) < 1e-7);

      ControlState none;
      none.values = Eigen::VectorXd::Zero(control_count(space, c));
      CHECK(control_points(space.primitive(part, none)) == control_points(space.rest(part)));
      if (const auto* cylinder = std::get_if<GeneralizedCylinder>(&space.rest(part)))
        CHECK(std::get<GeneralizedCylinder>(space.primitive(part, none)).radii == cylinder->radii);
    }
  }
}

TEST_CASE("rows of points and radii are what columns change of a primitive") {
  solids::Random random(13);
  for (const Structure& structure : structures_with_symmetry()) {
    const ControlSpace space(structure);
    for (int part = 0; part < static_cast<int>(structure.parts.size()); ++part) {
      const int c = space.class_of(part);
      Eigen::MatrixXd columns(control_count(space, c), 3);
      for (double& value : columns.reshaped()) value = random.uniform(-1, 1);
      const Eigen::Vector3d by = 0.1 * random.in_cube();
      const ControlState start = random_state(space, c, random);
      ControlState end = start;
      end.values += columns * by;
      const Primitive before = space.primitive(part, start), after = space.primitive(part, end);
      const Points moved = control_points(after) - control_points(before);
      for (int i = 0; i < static_cast<int>(moved.rows()); ++i)
        CHECK((space.point_rows(part, i, columns) * by - moved.row(i).transpose()).norm() < 1e-13);
      if (const auto* cylinder = std::get_if<GeneralizedCylinder>(&after))
        for (int i = 0; i < static_cast<int>(moved.rows()); ++i)
          CHECK(space.radius_row(part, i, columns).dot(by) ==
                Approx(cylinder->radii(i) - std::get<GeneralizedCylinder>(before).radii(i)).margin(1e-13));
    }
  }
}

TEST_CASE("the first member of a class lies on each of its members") {
  for (const Structure& structure : structures_with_symmetry()) {
    const ControlSpace space(structure);
    for (int part = 0; part < static_cast<int>(structure.parts.size()); ++part) {
      const int first = space.members(space.class_of(part)).front();
      const Points from = control_points(space.rest(first)), to = control_points(space.rest(part));
      const Eigen::RowVector3d from_middle = from.colwise().mean(), to_middle = to.colwise().mean();
      for (int i = 0; i < static_cast<int>(to.rows()); ++i) {
        const Eigen::Vector3d arm = (from.row(space.counterpart(part, i)) - from_middle).transpose();
        CHECK((space.linear(part) * arm - (to.row(i) - to_middle).transpose()).norm() < 1e-12);
      }
      CHECK(space.axial(part).determinant() == Approx(1).epsilon(1e-13));
      if (part == first) CHECK(space.linear(part) == Eigen::Matrix3d::Identity());
    }
  }
}

TEST_CASE("a symmetry that the primitives at rest do not have is refused by its name") {
  const double limit = 1e-6;  // of the diagonal
  for (const double share : {0.5, 2.0}) {
    Structure structure = structures::table().structure;
    auto& leg = std::get<Cuboid>(structure.parts[2].primitive);
    leg.corners.col(2).array() += share * limit * structure.diagonal;
    const std::string said = message_of<InputError>([&] { ControlSpace space(structure); });
    if (share < 1)
      CHECK(said == "accepted");
    else
      CHECK(mentions(said, "relation 2 (symmetry of 'leg_1' and 'leg_2') does not hold at rest"));
  }
}

}  // namespace stackabilization::control_space_test
