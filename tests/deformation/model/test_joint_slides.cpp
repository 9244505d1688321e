#include <Eigen/Geometry>

#include "deformation/model/joint_slides.h"
#include "stackabilization/deformation/controller_model.h"
#include "stackabilization/deformation/relation_residual.h"
#include "support/catch.h"
#include "support/structures.h"

using namespace stackabilization;

namespace {

Primitive box_of(const Eigen::Vector3d& centre, const Eigen::Vector3d& sides) {
  return cuboid_of({centre, Eigen::Matrix3d::Identity(), sides / 2});
}

/// Two parts with a point joint.
Structure joined(const Primitive& first, const Primitive& second, const Eigen::RowVector3d& point) {
  Structure structure;
  structure.parts = {{"first", first, {}}, {"second", second, {}}};
  Relation joint;
  joint.type = RelationType::point_joint;
  joint.parts = {0, 1};
  joint.points = point;
  structure.relations = {joint};
  structure.diagonal = 10;
  return structure;
}

int carrier_of(Structure structure) {
  detail::let_joints_slide(structure);
  return structure.relations.front().carrier;
}

const Primitive plate = box_of({0, 0, 0}, {8, 6, 0.5}), bar = box_of({0, 0, 3}, {0.5, 0.5, 6});

}  // namespace

TEST_CASE("Joints slide on plates and along members, but not at rims and ends", "[joints]") {
  CHECK(carrier_of(joined(plate, bar, {1, 1, 0})) == 0);
  CHECK(carrier_of(joined(plate, bar, {3.99, 1, 0})) == -1);  // rim of the plate, end of the bar
  CHECK(carrier_of(joined(bar, box_of({2, 0, 3}, {4, 0.4, 0.4}), {0, 0, 3})) ==
        0);  // middle of the first, end of the other
  CHECK(carrier_of(joined(box_of({0, 0, 0}, {2, 2, 2}), box_of({2, 0, 0}, {2, 2, 2}), {1, 0, 0})) == -1);
  const Primitive disc = structures::straight_cylinder({0, 0, 0}, {0, 0, 0.5}, 3, 4);
  CHECK(carrier_of(joined(disc, bar, {1, 1, 0.25})) == 0);
  CHECK(carrier_of(joined(disc, bar, {2.95, 0, 0.05})) == -1);
}

TEST_CASE("A joint is held along the normal of a plate and across a member, in every pose", "[joints]") {
  const Eigen::Matrix3d turn =
      Eigen::AngleAxisd(0.6, Eigen::Vector3d(1, 2, 3).normalized()).toRotationMatrix();
  const auto turned = [&](const Primitive& primitive) {
    Cuboid cuboid = std::get<Cuboid>(primitive);
    cuboid.corners = cuboid.corners * turn.transpose();
    return Primitive(cuboid);
  };
  const Eigen::Vector3d normal = turn * Eigen::Vector3d::UnitZ();
  CHECK(detail::held_directions(turned(plate)).isApprox(normal * normal.transpose(), 1e-12));
  CHECK(detail::held_directions(turned(bar))
            .isApprox(Eigen::Matrix3d::Identity() - normal * normal.transpose(), 1e-12));
  CHECK(detail::held_directions(box_of({0, 0, 0}, {1, 1, 1})).isIdentity());
}

TEST_CASE("A joint that slides has no residual along its carrier", "[joints]") {
  Structure structure = joined(plate, bar, {1, 1, 0});
  const std::vector<Primitive> moved = {plate, box_of({0.3, 0, 3.1}, {0.5, 0.5, 6})};
  CHECK(relation_residuals(structure, moved).front() == Approx(std::hypot(0.3, 0.1) / 10));
  detail::let_joints_slide(structure);
  CHECK(relation_residuals(structure, moved).front() == Approx(0.1 / 10));
  // 3 of the half width of 4 are left from x = 1.
  const std::vector<Primitive> beyond = {plate, box_of({3.5, 0, 3}, {0.5, 0.5, 6})};
  CHECK(relation_residuals(structure, beyond).front() == Approx(0.5 / 10));
}

TEST_CASE("Joints that slide hold after an edit", "[joints]") {
  const StructuredShape table = structures::table();
  const int leg = structures::part_named(table, "leg_1");
  const ControllerModel model(table, {}, Following::smooth);
  const Edit edit{{HandleKind::part, leg, 0}, Move{{0.1, 0, 0}}, Falloff::gaussian};
  const DeformationResult outcome = model.edited(model.at_rest(), edit);
  REQUIRE_FALSE(outcome.refusal);
  const auto move = [&](int part) {
    const auto row = static_cast<std::size_t>(part);
    return (control_points(outcome.design.primitives[row]) - control_points(model.at_rest().primitives[row]))
        .rowwise()
        .norm()
        .maxCoeff();
  };
  CHECK(move(leg) == Approx(0.1));
  for (const double residual : model.relation_residuals(outcome.design)) CHECK(residual <= 1e-9);
}
