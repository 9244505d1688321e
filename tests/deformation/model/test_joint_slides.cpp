#include <Eigen/Geometry>
#include <cmath>
#include <string>

#include "deformation/model/joint_slides.h"
#include "deformation/model/transfer.h"
#include "stackabilization/deformation/controller_model.h"
#include "stackabilization/deformation/relation_residual.h"
#include "stackabilization/deformation/tolerances.h"
#include "stackabilization/io/read.h"
#include "stackabilization/structure/analysis.h"
#include "support/catch.h"
#include "support/solids.h"
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

constexpr std::array<bool, 3> every_way = {true, true, true};

/// Directions in which a joint is held far from the rim.
Eigen::Matrix3d held(const Primitive& carrier, const Eigen::Vector3d& point) {
  return detail::held_directions(carrier, point, detail::sliding_ways(carrier, point));
}

int carrier_of(Structure structure) {
  detail::let_joints_yield(structure);
  return structure.relations.front().carrier;
}

using Ways = std::vector<std::array<bool, 3>>;

Ways ways_of(Structure structure) {
  detail::let_joints_yield(structure);
  return structure.relations.front().sliding;
}

const Primitive plate = box_of({0, 0, 0}, {8, 6, 0.5}), bar = box_of({0, 0, 3}, {0.5, 0.5, 6});

}  // namespace

TEST_CASE("Joints slide on plates and along members, but not at rims and ends", "[joints]") {
  CHECK(carrier_of(joined(plate, bar, {1, 1, 0})) == 0);
  CHECK(carrier_of(joined(plate, bar, {3.99, 2.99, 0})) == -1);  // corner of the plate, end of the bar
  CHECK(carrier_of(joined(bar, box_of({2, 0, 3}, {4, 0.4, 0.4}), {0, 0, 3})) ==
        0);  // middle of the first, end of the other
  CHECK(carrier_of(joined(box_of({0, 0, 0}, {2, 2, 2}), box_of({2, 0, 0}, {2, 2, 2}), {1, 0, 0})) == -1);
  const Primitive disc = structures::straight_cylinder({0, 0, 0}, {0, 0, 0.5}, 3, 4);
  CHECK(carrier_of(joined(disc, bar, {1, 1, 0.25})) == 0);
  CHECK(carrier_of(joined(disc, bar, {2.95, 0, 0.05})) == -1);
  const Primitive arm = box_of({2, 0, 3}, {4, 0.4, 0.4});
  const Primitive leg = structures::straight_cylinder({0, 0, 0}, {0, 0, 6}, 0.3, 13);
  CHECK(carrier_of(joined(leg, arm, {0, 0, 3})) == 0);
  CHECK(carrier_of(joined(leg, arm, {0, 0, 5.95})) == -1);
  // What belongs near the end of a member, round or square, stays there.
  for (const Primitive& member : {leg, bar}) {
    CHECK(carrier_of(joined(member, arm, {0, 0, 5.5})) == 0);
    CHECK(carrier_of(joined(member, arm, {0, 0, 5.6})) == -1);
    CHECK(carrier_of(joined(member, arm, {0, 0, 0.4})) == -1);
  }
  // The end of a slender one is three half widths long.
  const Primitive slender = structures::straight_cylinder({0, 0, 0}, {0, 0, 6}, 0.1, 13);
  for (const Primitive& member : {slender, box_of({0, 0, 3}, {0.2, 0.1, 6})}) {
    CHECK(carrier_of(joined(member, arm, {0, 0, 0.31})) == 0);
    CHECK(carrier_of(joined(member, arm, {0, 0, 0.29})) == -1);
  }
  CHECK(carrier_of(joined(structures::straight_cylinder({0, 0, 0}, {0, 0, 5.9}, 1, 13), arm, {0, 0, 3})) ==
        -1);
  CHECK(carrier_of(joined(structures::arc_cylinder(3, 0.3, -1, 1, 13), box_of({5, 0, 0}, {4, 0.4, 0.4}),
                          {3, 0, 0})) == -1);
}

TEST_CASE("A joint is held along the normal of a plate and across a member, in every pose", "[joints]") {
  const Eigen::Matrix3d turn =
      Eigen::AngleAxisd(0.6, Eigen::Vector3d(1, 2, 3).normalized()).toRotationMatrix();
  const auto turned = [&](const Primitive& primitive) {
    Cuboid cuboid = std::get<Cuboid>(primitive);
    cuboid.corners = cuboid.corners * turn.transpose();
    return Primitive(cuboid);
  };
  const Eigen::Vector3d normal = turn * Eigen::Vector3d::UnitZ(), origin = Eigen::Vector3d::Zero();
  CHECK(held(turned(plate), origin).isApprox(normal * normal.transpose(), 1e-12));
  CHECK(held(turned(bar), origin).isApprox(Eigen::Matrix3d::Identity() - normal * normal.transpose(), 1e-12));
  CHECK(held(box_of({0, 0, 0}, {1, 1, 1}), origin).isIdentity());
  const Eigen::Vector3d top = 6 * normal;
  CHECK(held(structures::straight_cylinder({0, 0, 0}, top, 0.3, 5), origin)
            .isApprox(Eigen::Matrix3d::Identity() - normal * normal.transpose(), 1e-12));
  CHECK(held(structures::straight_cylinder({0, 0, 0}, top, 8, 5), origin)
            .isApprox(normal * normal.transpose(), 1e-12));
}

TEST_CASE("A joint slides on the wall of a hollow box, held across it", "[joints]") {
  Cuboid crate = std::get<Cuboid>(box_of({0, 0, 3}, {8, 6, 6}));
  const Primitive grip = box_of({4.2, 0, 4}, {0.4, 0.4, 0.4});
  CHECK(carrier_of(joined(crate, grip, {4, 0, 4})) == -1);  // solid
  crate.inner_sides << 0.9, 0.9, 0.9, 0.9, 1, 1;
  CHECK(carrier_of(joined(crate, grip, {4, 0, 4})) == 0);
  CHECK(carrier_of(joined(crate, grip, {3.6, 0, 4})) == 0);  // the inner side of the wall
  CHECK(carrier_of(joined(crate, grip, {3, 0, 4})) == -1);   // the room within
  CHECK(carrier_of(joined(crate, grip, {0, 0, 0})) == -1);   // the floor
  CHECK(ways_of(joined(crate, grip, {4, 0, 4})) == Ways{{false, true, true}});
  CHECK(ways_of(joined(crate, grip, {4, 2.6, 4})).empty());  // near the edge of two walls
  CHECK(ways_of(joined(crate, grip, {4, 0, 5.6})).empty());  // near the rim
  const Eigen::Vector3d x = Eigen::Vector3d::UnitX(), y = Eigen::Vector3d::UnitY();
  CHECK(held(crate, {4, 0, 4}).isApprox(x * x.transpose(), 1e-12));
  CHECK(held(crate, {1, -3, 4}).isApprox(y * y.transpose(), 1e-12));

  Structure structure = joined(crate, grip, {4, 0, 4});
  detail::let_joints_yield(structure);
  const auto residual = [&](const Cuboid& body, const Eigen::Vector3d& by) {
    Cuboid moved = std::get<Cuboid>(grip);
    moved.corners.rowwise() += by.transpose();
    return relation_residuals(structure, {body, moved}).front();
  };
  CHECK(residual(crate, {0, 1, 1}) == Approx(0).margin(1e-12));
  CHECK(residual(crate, {0.2, 1, 1}) == Approx(0.2 / 10 - tolerance::joint_slack));
  CHECK(residual(crate, {0, 0, 2.5}) == Approx(0.5 / 10));  // above the rim, at 6
  // Where the foot is half as wide, the wall leans by 2 over 6, and what rises by 1.5 goes out by 0.5.
  Cuboid drafted = crate;
  for (int corner = 0; corner < 8; ++corner)
    if (drafted.corners(corner, 2) == 0) drafted.corners(corner, 0) /= 2;
  const double inwards = (4.0 - 2) * (6.0 - 4) / 6;
  CHECK(residual(drafted, {-inwards, 0, 0}) == Approx(0).margin(1e-12));
  CHECK(residual(drafted, {0.5 - inwards, 0, 1.5}) == Approx(0).margin(1e-12));
}

TEST_CASE("A joint slides up and down the wall of a vessel, held across it", "[joints]") {
  // Its radius grows from 1 to 2 over a height of 4.
  GeneralizedCylinder cup = structures::straight_cylinder({0, 0, 0}, {0, 0, 4}, 1, 9);
  for (Eigen::Index i = 0; i < 9; ++i) cup.radii(i) = 1 + static_cast<double>(i) / 8;
  const Primitive grip = box_of({1.6, 0, 2}, {0.2, 0.2, 0.2});
  CHECK(carrier_of(joined(cup, grip, {1.5, 0, 2})) == -1);  // solid
  cup.inner_radii = cup.radii.array() - 0.1;
  CHECK(carrier_of(joined(cup, grip, {1.5, 0, 2})) == 0);
  CHECK(carrier_of(joined(cup, grip, {1.95, 0, 3.8})) == -1);  // near the rim
  GeneralizedCylinder dish = cup;
  dish.centres *= 0.5;
  CHECK(carrier_of(joined(dish, grip, {1.5, 0, 1})) == -1);

  Structure structure = joined(cup, grip, {1.5, 0, 2});
  detail::let_joints_yield(structure);
  const auto residual = [&](const Eigen::Vector3d& by) {
    Cuboid moved = std::get<Cuboid>(grip);
    moved.corners.rowwise() += by.transpose();
    return relation_residuals(structure, {cup, moved}).front();
  };
  CHECK(residual({0.25, 0, 1}) == Approx(0).margin(1e-12));
  CHECK(residual({-0.25, 0, -1}) == Approx(0).margin(1e-12));
  CHECK(residual({0, 0.2, 0}) == Approx(0.2 / 10 - tolerance::joint_slack));
  CHECK(residual({0, 0, 1}) == Approx(0.25 * 4 / std::sqrt(17) / 10 - tolerance::joint_slack));
  CHECK(residual({0.75, 0, 3}) == Approx(1.0 / 10));  // above the rim
}

TEST_CASE("A joint that slides has no residual along its carrier", "[joints]") {
  Structure structure = joined(plate, bar, {1, 1, 0});
  const std::vector<Primitive> moved = {plate, box_of({0.3, 0, 3.1}, {0.5, 0.5, 6})};
  CHECK(relation_residuals(structure, moved).front() == Approx(std::hypot(0.3, 0.1) / 10));
  detail::let_joints_yield(structure);
  CHECK(relation_residuals(structure, moved).front() == Approx(0.1 / 10 - tolerance::joint_slack));
  // 3 of the half width of 4 are left from x = 1.
  const std::vector<Primitive> beyond = {plate, box_of({3.5, 0, 3}, {0.5, 0.5, 6})};
  CHECK(relation_residuals(structure, beyond).front() == Approx(0.5 / 10));
}

TEST_CASE("A leg leans on the slack of its joints, and all else stays", "[joints]") {
  const StructuredShape rest = structures::leg_and_apron();
  const int leg = structures::part_named(rest, "leg"), apron = structures::part_named(rest, "apron");
  const double slack = tolerance::joint_slack * rest.structure.diagonal;
  const ControllerModel smooth(rest, {}, Following::smooth), free(rest, {});
  DeformationConstraints constraints;
  constraints.keep_extent = Direction(Eigen::Vector3d::UnitZ());
  constraints.extent_ends = ExtentEnds::fixed;
  const auto moved = [&](const ControllerModel& model, double by) {
    const Edit edit{{HandleKind::face, leg, 4}, Move{{by, 0, 0}}};
    DeformationResult outcome = model.edited(model.at_rest(), edit, constraints);
    REQUIRE_FALSE(outcome.refusal);
    return std::move(outcome.design.primitives);
  };
  const auto primitive = [&](int part) -> const Primitive& {
    return rest.structure.parts[static_cast<std::size_t>(part)].primitive;
  };
  // How far a joint of the apron opens.
  const auto gap_to = [&](int other, const Eigen::Vector3d& joint, const std::vector<Primitive>& now) {
    const auto place = [&](int part) {
      return deform_point(primitive(part), now[static_cast<std::size_t>(part)], joint);
    };
    return (place(other) - place(apron)).norm();
  };
  const auto gap = [&](const std::vector<Primitive>& now) { return gap_to(leg, {0.4, 0, 9.5}, now); };
  // The joint is a twentieth of the height below the top, where the leg stays.
  const double enough = 20 * slack;
  const std::vector<Primitive> within = moved(smooth, 0.9 * enough);
  for (std::size_t part = 0; part < within.size(); ++part)
    if (static_cast<int>(part) != leg)
      CHECK(control_points(within[part]) == control_points(primitive(static_cast<int>(part))));
  CHECK(gap(within) == Approx(0.9 * slack));
  // Beyond the slack the apron is drawn along, as far as the slack does not reach.
  const std::vector<Primitive> farther = moved(smooth, 3 * enough);
  CHECK(control_points(farther[static_cast<std::size_t>(apron)]) != control_points(primitive(apron)));
  CHECK(gap(farther) == Approx(slack));
  // Where the top has to stay, a part of the slack of the other end of the apron is used too.
  constraints.fixed_parts = {structures::part_named(rest, "top")};
  const std::vector<Primitive> held = moved(smooth, 1.5 * enough);
  const double at_rim = gap_to(constraints.fixed_parts.front(), {4.9, 0, 10}, held);
  CHECK(gap(held) == Approx(slack));
  CHECK(at_rim > 0.005 * slack);
  CHECK(at_rim <= slack * (1 + 1e-6));
  CHECK(gap(moved(free, 0.9 * enough)) <= tolerance::relation * rest.structure.diagonal);
}

TEST_CASE("Each point of a joint slides along the edges that it is far from", "[joints]") {
  // A panel, 6 deep and 10 high. A shelf that is flush with its edges may move up and down, a back that runs
  // from its top may end higher, and neither comes off the edge.
  const Primitive panel = box_of({0, 0, 5}, {0.5, 6, 10});
  const Primitive shelf = box_of({2.25, 0, 4}, {4, 6, 0.5}), back = box_of({2.25, 2.9, 6}, {4, 0.2, 8});
  const auto line = [](const Primitive& first, const Primitive& second, const Eigen::RowVector3d& from,
                       const Eigen::RowVector3d& to) {
    Structure structure = joined(first, second, from);
    Relation& joint = structure.relations.front();
    joint.type = RelationType::line_joint;
    joint.points.conservativeResize(2, 3);
    joint.points.row(1) = to;
    detail::let_joints_yield(structure);
    return structure;
  };
  const Structure flush = line(panel, shelf, {0.25, -3, 4}, {0.25, 3, 4});
  const std::array<bool, 3> upright = {false, false, true}, in_plane = {false, true, true}, none{};
  CHECK(flush.relations.front().sliding == Ways{upright, upright});
  CHECK(line(panel, shelf, {0.25, -2, 4}, {0.25, 3, 4}).relations.front().sliding == Ways{in_plane, upright});
  const Structure hanging = line(panel, back, {0.25, 2.95, 2}, {0.25, 2.95, 10});
  CHECK(hanging.relations.front().sliding == Ways{upright, none});
  CHECK(hanging.relations.front().carrier == 0);
  CHECK(line(panel, back, {0.25, 2.95, 0}, {0.25, 2.95, 10}).relations.front().carrier == -1);

  // What slides along an edge of one part and anywhere on the other is carried by the other; else the joint
  // is carried where it is nearest to the middle: a shelf moves up a post, not the post within the shelf.
  CHECK(line(shelf, panel, {0.25, -2, 4}, {0.25, 2, 4}).relations.front().carrier == 1);
  const Primitive post = box_of({2, 2, 5}, {0.4, 0.4, 10});
  CHECK(carrier_of(joined(box_of({0, 0, 5}, {6, 6, 0.3}), post, {2, 2, 5})) == 1);

  // Boards that meet at a corner stay there, as far from their edges as half of their thickness.
  const Primitive seat = box_of({2.75, 0, 9.75}, {5, 6, 0.5});
  CHECK(line(panel, seat, {0.25, -3, 9.75}, {0.25, 3, 9.75}).relations.front().carrier == -1);

  const auto residual = [&](const Structure& structure, const Eigen::Vector3d& by) {
    Cuboid moved = std::get<Cuboid>(structure.parts[1].primitive);
    moved.corners.rowwise() += by.transpose();
    return relation_residuals(structure, {panel, moved}).front() + tolerance::joint_slack;
  };
  CHECK(residual(flush, {0, 0, 2}) == tolerance::joint_slack);
  CHECK(residual(flush, {0, 0.5, 2}) == Approx(0.05));
  CHECK(residual(hanging, {0, 0, 0.5}) == Approx(0.05));  // at the top
  Cuboid shorter = std::get<Cuboid>(back);
  for (int corner = 0; corner < 4; ++corner) shorter.corners(corner, 2) += 1.5;
  CHECK(relation_residuals(hanging, {panel, shorter}).front() == 0);
}

TEST_CASE("A leg that is flush with the side of a top stays flush", "[joints]") {
  // Half of the leg's thickness is 0.25.
  const auto leg_at = [](double x, double y) {
    return ways_of(joined(plate, box_of({x, y, -3}, {0.5, 0.5, 5.5}), {x, y, -0.25}));
  };
  CHECK(leg_at(3.6, 1) == Ways{{true, true, false}});
  CHECK(leg_at(3.75, 1) == Ways{{false, true, false}});
  CHECK(leg_at(-3.75, -2.75).empty());
  const Primitive disc = structures::straight_cylinder({0, 0, 0}, {0, 0, 0.5}, 3, 4);
  const auto round_leg_at = [&](double x) {
    const Primitive leg = structures::straight_cylinder({x, 0, -6}, {x, 0, 0}, 0.3, 13);
    return carrier_of(joined(disc, leg, {x, 0, 0}));
  };
  CHECK(round_leg_at(2.6) == 0);
  CHECK(round_leg_at(2.7) == -1);
}

TEST_CASE("A joint is beyond a round member past its ends", "[joints]") {
  const Primitive leg = structures::straight_cylinder({0, 0, 0}, {0, 0, 6}, 0.3, 13);
  CHECK(detail::distance_beyond(leg, {0.2, 0, 5.5}, every_way) == 0);
  CHECK(detail::distance_beyond(leg, {0.2, 0, 6.5}, every_way) == Approx(0.5));
  CHECK(detail::distance_beyond(leg, {0, 0, -0.25}, every_way) == Approx(0.25));
}

TEST_CASE("A joint is beyond a plate past its own edges, not those of a box around it") {
  // A panel, 8 wide at the bottom, 12 at the top, and 10 high: its sides are x = 4 + 0.2 z and the mirror
  // image.
  Cuboid panel = cuboid_of({{0, 0, 5}, Eigen::Matrix3d::Identity(), {5, 0.25, 5}});
  for (int corner = 0; corner < 8; ++corner) panel.corners(corner, 0) *= corner < 4 ? 0.8 : 1.2;
  const auto beyond = [&](double x, double z) {
    return detail::distance_beyond(panel, {x, 0.25, z}, {true, false, true});
  };
  CHECK(beyond(5.9, 10) == 0);
  CHECK(beyond(-5.9, 10) == 0);
  CHECK(beyond(3.9, 0) == 0);
  CHECK(beyond(4.9, 0) == Approx(0.9 / std::hypot(1, 0.2)));
  CHECK(beyond(-6.5, 10) == Approx(0.5 / std::hypot(1, 0.2)));
  CHECK(beyond(0, 10.5) == Approx(0.5));
  CHECK(beyond(0, -0.1) == Approx(0.1));
  // A leg that leans has level ends: its foot is beyond them by its height, not by its way along the axis.
  Cuboid leg = cuboid_of({{0, 0, 5}, Eigen::Matrix3d::Identity(), {0.5, 0.5, 5}});
  for (int corner = 4; corner < 8; ++corner) leg.corners(corner, 0) += 10;
  CHECK(detail::distance_beyond(leg, {0.4, 0, 0}, {false, false, true}) == 0);
  CHECK(detail::distance_beyond(leg, {11, 0, 11}, {false, false, true}) == Approx(1));
}

TEST_CASE("A rung that moves up between legs that lean gets shorter, and the legs stay", "[joints]") {
  const StructuredShape trestle = structures::trestle();
  const int rung = structures::part_named(trestle, "rung");
  const ControllerModel smooth(trestle, {}, Following::smooth), free(trestle, {});
  const auto moved = [&](const ControllerModel& model, const Eigen::Vector3d& by) {
    return model.edited(model.at_rest(), {{HandleKind::part, rung, 0}, Move{by}});
  };
  const DeformationResult up = moved(smooth, {0, 0, 2});
  REQUIRE_FALSE(up.refusal);
  for (const char* leg : {"leg_left", "leg_right"}) {
    const auto row = static_cast<std::size_t>(structures::part_named(trestle, leg));
    CHECK(control_points(up.design.primitives[row]) ==
          control_points(trestle.structure.parts[row].primitive));
  }
  const Points centres = control_points(up.design.primitives[static_cast<std::size_t>(rung)]);
  // The axes of the legs are 2.8 from the middle at a height of 6 and lean by 0.2; the joints have their
  // slack across them.
  const double slack = tolerance::joint_slack * trestle.structure.diagonal;
  for (Eigen::Index i = 0; i < centres.rows(); ++i) {
    const Eigen::RowVector3d expected(-2.8 + 5.6 * static_cast<double>(i) / 8, 0, 6);
    CHECK((centres.row(i) - expected).norm() <= slack * std::hypot(1, 0.2) * (1 + 1e-6));
  }
  // With parts that follow in any way the rung keeps its length, and the legs give way.
  const DeformationResult kept = moved(free, {0, 0, 2});
  REQUIRE_FALSE(kept.refusal);
  const Points rigid = control_points(kept.design.primitives[static_cast<std::size_t>(rung)]);
  CHECK((rigid.row(8) - rigid.row(0)).norm() == Approx(6.4));
  // No change of the rung alone takes it out of the plane of the legs: they come along.
  const DeformationResult aside = moved(smooth, {0, 0.5, 0});
  REQUIRE_FALSE(aside.refusal);
  for (const double residual : smooth.relation_residuals(aside.design)) CHECK(residual <= 1e-6);
  CHECK(control_points(aside.design.primitives[static_cast<std::size_t>(rung)])(4, 1) == Approx(0.5));
}

TEST_CASE("A rung that would have to tilt far to give way moves as it is, and the legs come along",
          "[joints]") {
  StructuredShape trestle = structures::trestle();
  std::erase_if(trestle.structure.relations, [](const Relation& relation) {
    return relation.type == RelationType::symmetry || relation.type == RelationType::self_symmetry;
  });
  const int rung = structures::part_named(trestle, "rung");
  const ControllerModel smooth(trestle, {}, Following::smooth);
  // To stay on the axes of the legs, one end would go up and the other down by five times the move.
  const DeformationResult aside =
      smooth.edited(smooth.at_rest(), {{HandleKind::part, rung, 0}, Move{{0.1, 0, 0}}});
  REQUIRE_FALSE(aside.refusal);
  const Points before = control_points(trestle.structure.parts[static_cast<std::size_t>(rung)].primitive),
               after = control_points(aside.design.primitives[static_cast<std::size_t>(rung)]);
  for (Eigen::Index i = 0; i < before.rows(); ++i)
    CHECK((after.row(i) - before.row(i) - Eigen::RowVector3d(0.1, 0, 0)).norm() < 1e-12);
  for (const double residual : smooth.relation_residuals(aside.design)) CHECK(residual <= 1e-6);
}

TEST_CASE("A bar that lifts off the end of a post does not become thicker to stay on it", "[joints]") {
  Structure structure = joined(structures::straight_cylinder({0, 0, 0}, {0, 0, 6}, 0.3, 13),
                               structures::straight_cylinder({-4, 0, 6.2}, {4, 0, 6.2}, 0.2, 17), {0, 0, 6});
  StructuredShape gallows{
      concatenate(solids::cylinder(0.3, 6, 24), solids::box({-4, -0.2, 6}, {4, 0.2, 6.4})),
      std::move(structure)};
  gallows.shape.part_names = {"first", "second"};
  const ControllerModel smooth(gallows, {}, Following::smooth);
  const DeformationResult up = smooth.edited(smooth.at_rest(), {{HandleKind::part, 1, 0}, Move{{0, 0, 0.5}}});
  REQUIRE_FALSE(up.refusal);
  const auto& before = std::get<GeneralizedCylinder>(gallows.structure.parts[1].primitive);
  const auto& after = std::get<GeneralizedCylinder>(up.design.primitives[1]);
  CHECK((after.radii - before.radii).cwiseAbs().maxCoeff() <= 0.25 * 0.5);
  CHECK((after.centres - before.centres).rowwise().norm().maxCoeff() == Approx(0.5));
  for (const double residual : smooth.relation_residuals(up.design)) CHECK(residual <= 1e-6);
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

TEST_CASE("Handles and grips move up a wall, and the wall stays", "[joints]") {
  const auto moves = [](const std::string& name, const std::string& handle) {
    const StructuredShape rest =
        analyse_structure(read_shape(STACKABILIZATION_SOURCE_DIR "/data/models/" + name + ".obj"));
    const ControllerModel model(rest, {}, Following::smooth);
    const double rise = 0.01;
    const DeformationResult outcome = model.edited(
        model.at_rest(), {{HandleKind::part, structures::part_named(rest, handle), 0}, Move{{0, 0, rise}}});
    REQUIRE_FALSE(outcome.refusal);
    const auto body = static_cast<std::size_t>(structures::part_named(rest, "body"));
    return (control_points(outcome.design.primitives[body]) -
            control_points(model.at_rest().primitives[body]))
               .rowwise()
               .norm()
               .maxCoeff() /
           rise;
  };
  CHECK(moves("crate", "grip_left") < 0.01);
  CHECK(moves("bucket_with_handles", "handle_left") < 0.01);
}
