#include <algorithm>
#include <cmath>
#include <numbers>

#include "stackabilization/core/errors.h"
#include "stackabilization/structure/analysis.h"
#include "structure/model/correspondence.h"
#include "structure/model/nearest_box.h"
#include "support/catch.h"
#include "support/messages.h"
#include "support/variants.h"

using namespace stackabilization;

namespace {

const Symmetry across_x{.axis = Eigen::Vector3d::UnitX()};
const Symmetry across_y{.axis = Eigen::Vector3d::UnitY()};

Primitive leg_box(const Eigen::Vector3d& centre, solids::Random& random, double noise) {
  OrientedBox box;
  box.centre = centre + noise * random.in_cube();
  box.half_extents = Eigen::Vector3d(0.5, 0.25, 3) + noise * random.in_cube();
  box.axes = Eigen::AngleAxisd(noise * random.uniform(-1, 1), random.on_sphere()).toRotationMatrix();
  return cuboid_of(box);
}

Primitive leg_curve(const Eigen::Vector3d& centre, solids::Random& random, double noise) {
  GeneralizedCylinder cylinder;
  cylinder.centres.resize(9, 3);
  cylinder.radii.resize(9);
  for (int k = 0; k < 9; ++k) {
    cylinder.centres.row(k) =
        (centre + Eigen::Vector3d(0, 0, k - 4.0) + noise * random.in_cube()).transpose();
    cylinder.radii(k) = 0.5 + noise * random.uniform();
  }
  if (random.below(2) == 1) {
    cylinder.centres = cylinder.centres.colwise().reverse().eval();
    cylinder.radii.reverseInPlace();
  }
  return cylinder;
}

Relation pair(int a, int b, const Symmetry& symmetry) {
  return {.type = RelationType::symmetry, .parts = {a, b}, .symmetry = symmetry, .points = {}};
}
Relation self(int a, const Symmetry& symmetry) {
  return {.type = RelationType::self_symmetry, .parts = {a}, .symmetry = symmetry, .points = {}};
}

/// Four legs in a cycle, as in a table.
template <class Leg>
Structure four_legs(const Leg& leg, double noise) {
  solids::Random random(4);
  Structure structure;
  structure.diagonal = 12;
  structure.symmetries = {across_x, across_y};
  for (const auto& [x, y] : {std::pair(4, 3), {-4, 3}, {-4, -3}, {4, -3}})
    structure.parts.push_back({"leg_" + std::to_string(structure.parts.size() + 1),
                               leg(Eigen::Vector3d(x, y, 3), random, noise),
                               {}});
  structure.relations = {pair(0, 1, across_x), pair(1, 2, across_y), pair(2, 3, across_x),
                         pair(3, 0, across_y)};
  return structure;
}

double largest_miss(const Structure& structure) {
  double most = 0;
  for (const Relation& relation : structure.relations) {
    if (relation.points.rows() > 0) continue;
    const auto& part = [&](int row) -> const Primitive& {
      return structure.parts[static_cast<std::size_t>(row)].primitive;
    };
    const Primitive &a = part(relation.parts.front()), &b = part(relation.parts.back());
    const Eigen::Isometry3d map = isometry_of(relation.symmetry);
    const std::vector<int> to = control_correspondence(a, b, map);
    REQUIRE(!to.empty());
    for (std::size_t k = 0; k < to.size(); ++k) {
      const Eigen::Vector3d image = map * control_points(a).row(static_cast<Eigen::Index>(k)).transpose();
      most = std::max(most, (image.transpose() - control_points(b).row(to[k])).norm());
      if (const auto* cylinder = std::get_if<GeneralizedCylinder>(&a))
        most = std::max(most, std::abs(cylinder->radii(static_cast<Eigen::Index>(k)) -
                                       std::get<GeneralizedCylinder>(b).radii(to[k])));
    }
  }
  return most;
}

std::string refusal_to_symmetrize(Structure structure) {
  return message_of<InputError>([&] { symmetrize(structure); });
}

}  // namespace

TEST_CASE("four legs with noise become exactly symmetric, and stay near where they were") {
  for (const double noise : {0.0, 1e-6, 0.05}) {
    for (Structure structure : {four_legs(leg_box, noise), four_legs(leg_curve, noise)}) {
      const Structure before = structure;
      symmetrize(structure);
      CHECK(largest_miss(structure) < 1e-13 * structure.diagonal);
      for (std::size_t k = 0; k < 4; ++k) {
        const Primitive &now = structure.parts[k].primitive, &then = before.parts[k].primitive;
        CHECK((control_points(now) - control_points(then)).rowwise().norm().maxCoeff() <= 6 * noise + 1e-14);
        if (const auto* cuboid = std::get_if<Cuboid>(&now)) {
          CHECK(is_box(*cuboid));
          CHECK(nearest_box(*cuboid).axes.determinant() > 0);
        }
      }
    }
  }
}

TEST_CASE("without noise nothing changes beyond rounding, and the mean is the mean") {
  Structure structure = four_legs(leg_box, 0);
  OrientedBox box = nearest_box(std::get<Cuboid>(structure.parts[0].primitive));
  box.centre.z() += 0.4;
  box.half_extents.y() += 0.1;
  structure.parts[0].primitive = cuboid_of(box);
  symmetrize(structure);
  for (const Part& part : structure.parts) {
    const OrientedBox mean = nearest_box(std::get<Cuboid>(part.primitive));
    CHECK(mean.centre.z() == Approx(3.1).epsilon(1e-14));
    CHECK(mean.half_extents.y() == Approx(0.275).epsilon(1e-14));
    CHECK(std::abs(mean.centre.x()) == Approx(4).epsilon(1e-14));
  }
}

TEST_CASE("planes found with errors are made to fit, so that cycles close") {
  Structure structure = four_legs(leg_box, 0.01);
  structure.symmetries = {};
  structure.relations[0].symmetry.axis = Eigen::Vector3d(1, 0.004, 0);
  structure.relations[1].symmetry.axis = Eigen::Vector3d(0.003, 1, -0.002);
  structure.relations[2].symmetry.point = {0.02, 1, 0};
  structure.relations[3].symmetry.point = {5, -0.03, 2};
  symmetrize(structure);
  CHECK(largest_miss(structure) < 1e-13 * structure.diagonal);
  CHECK(std::abs(structure.relations[0].symmetry.axis.dot(structure.relations[1].symmetry.axis)) < 1e-15);
  CHECK((structure.relations[0].symmetry.axis - structure.relations[2].symmetry.axis).norm() == 0);
}

TEST_CASE("a regular pentagon of legs closes through two planes 36 degrees apart, found a little off") {
  Structure structure;
  structure.diagonal = 10;
  solids::Random random(2);
  const auto direction = [](double degrees) {
    return Eigen::Vector3d(std::cos(degrees * std::numbers::pi / 180),
                           std::sin(degrees * std::numbers::pi / 180), 0);
  };
  for (int k = 0; k < 5; ++k) {
    const Primitive leg = leg_curve(5 * direction(72 * k), random, 0.02);
    structure.parts.push_back({"leg_" + std::to_string(k), leg, {}});
  }
  // Mirror a through leg 0, mirror b 36 degrees on, through leg 3: 0 -b- 1 -a- 4 -b- 2 -a- 3.
  const Symmetry a{.axis = direction(90)}, b{.axis = direction(126.2)};
  structure.relations = {pair(0, 1, b), pair(1, 4, a), pair(4, 2, b), pair(2, 3, a), self(0, a), self(3, b)};
  symmetrize(structure);
  CHECK(largest_miss(structure) < 1e-13 * structure.diagonal);
  CHECK(structure.relations[0].symmetry.axis.dot(structure.relations[1].symmetry.axis) ==
        Approx(std::cos(std::numbers::pi / 5)).epsilon(1e-14));
}

TEST_CASE("self-symmetries put curves into planes and onto axes, and reverse them across a plane") {
  solids::Random random(8);
  Structure structure;
  structure.diagonal = 9;
  structure.parts = {{"body", leg_curve({0.01, -0.02, 0.03}, random, 0.02), {}}};
  structure.relations = {self(0, across_x)};
  SECTION("a plane that contains the curve") {
    symmetrize(structure);
    CHECK(control_points(structure.parts[0].primitive).col(0).cwiseAbs().maxCoeff() < 1e-15);
  }
  SECTION("a plane across it") {
    structure.relations = {self(0, {.axis = Eigen::Vector3d::UnitZ()})};
    symmetrize(structure);
    const auto& body = std::get<GeneralizedCylinder>(structure.parts[0].primitive);
    for (int k = 0; k < 9; ++k) {
      CHECK(body.radii(k) == Approx(body.radii(8 - k)).epsilon(1e-14));
      CHECK(body.centres(k, 0) == Approx(body.centres(8 - k, 0)).epsilon(1e-14));
      CHECK(body.centres(k, 2) == Approx(-body.centres(8 - k, 2)).margin(1e-14));
    }
  }
  SECTION("a body of revolution") {
    structure.relations = {self(0, across_x), self(0, across_y),
                           self(0, {.kind = SymmetryKind::revolution, .axis = Eigen::Vector3d::UnitZ()})};
    symmetrize(structure);
    CHECK(control_points(structure.parts[0].primitive).leftCols(2).cwiseAbs().maxCoeff() < 1e-15);
  }
  CHECK(largest_miss(structure) < 1e-13 * structure.diagonal);
}

TEST_CASE("a square box that lies askew to its mirror planes is turned to them") {
  OrientedBox box;
  box.half_extents = {2, 2, 0.5};
  for (const double degrees : {3.0, 20.0, 45.0, 70.0}) {
    box.axes =
        Eigen::AngleAxisd(degrees * std::numbers::pi / 180, Eigen::Vector3d::UnitZ()).toRotationMatrix();
    Structure structure;
    structure.diagonal = 6;
    structure.parts = {{"plate", cuboid_of(box), {}}};
    structure.relations = {self(0, across_x), self(0, across_y)};
    symmetrize(structure);
    CHECK(largest_miss(structure) < 1e-13 * structure.diagonal);
    const OrientedBox turned = nearest_box(std::get<Cuboid>(structure.parts[0].primitive));
    Eigen::Vector3d sorted = turned.half_extents;
    std::sort(sorted.begin(), sorted.end());
    CHECK((sorted - Eigen::Vector3d(0.5, 2, 2)).norm() < 1e-12);
  }
}

TEST_CASE("the kind that fits better in sum wins for all symmetric parts") {
  solids::Random random(6);
  Structure structure = four_legs(leg_box, 0.01);
  for (Part& part : structure.parts) part.fit = {.cuboid_error = 0.02, .cylinder_error = 0.03, .note = ""};
  structure.parts[2].primitive = leg_curve({-4, -3, 3}, random, 0);
  structure.parts[2].fit = {.cuboid_error = 0.02, .cylinder_error = 0.01, .note = ""};
  symmetrize(structure);
  for (const Part& part : structure.parts) CHECK(std::holds_alternative<Cuboid>(part.primitive));
  CHECK(largest_miss(structure) < 1e-13 * structure.diagonal);

  structure = four_legs(leg_box, 0.01);
  for (Part& part : structure.parts) part.fit = {.cuboid_error = 0.02, .cylinder_error = 0.03, .note = ""};
  structure.parts[2].primitive = leg_curve({-4, -3, 3}, random, 0);
  structure.parts[2].fit.cylinder_error = 0.001;
  for (Part& part : structure.parts) part.fit.cuboid_error = 0.04;
  symmetrize(structure);
  for (const Part& part : structure.parts) CHECK(std::holds_alternative<GeneralizedCylinder>(part.primitive));
  CHECK(largest_miss(structure) < 1e-13 * structure.diagonal);
}

TEST_CASE("relations that contradict each other are refused by name, and nothing is changed") {
  Structure structure = four_legs(leg_box, 0.01);
  structure.relations[2].symmetry.point.x() = 1;
  const std::string message = refusal_to_symmetrize(structure);
  CHECK(message.find("contradict each other") != std::string::npos);
  for (const char* name : {"relation 0", "relation 3", "'leg_1'", "'leg_4'"})
    CHECK(message.find(name) != std::string::npos);
  const Structure before = structure;
  CHECK_THROWS_AS(symmetrize(structure), InputError);
  CHECK(control_points(structure.parts[0].primitive) == control_points(before.parts[0].primitive));

  structure = four_legs(leg_box, 0.01);
  structure.relations.push_back(self(1, {.point = {-4, 0, 0}}));
  structure.relations.push_back(self(1, {.point = {-4.3, 0, 0}}));
  CHECK(refusal_to_symmetrize(structure).find(
            "relation 4 (self-symmetry of 'leg_2') and relation 5 (self-symmetry of 'leg_2') contradict") !=
        std::string::npos);

  structure = four_legs(leg_box, 0);
  structure.relations = {self(
      0, {.kind = SymmetryKind::rotation, .point = {4, 3, 3}, .axis = Eigen::Vector3d::UnitZ(), .order = 3})};
  CHECK(refusal_to_symmetrize(structure).find("relation 0 (self-symmetry of 'leg_1') cannot hold exactly") !=
        std::string::npos);
}
