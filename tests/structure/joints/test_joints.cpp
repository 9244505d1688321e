#include <algorithm>
#include <numbers>

#include "stackabilization/core/errors.h"
#include "stackabilization/structure/joints.h"
#include "support/catch.h"
#include "support/solids.h"
#include "support/symmetric_solids.h"
#include "support/variants.h"

using namespace stackabilization;

namespace {

/// Axis-aligned boxes stand in for primitives; closed surfaces do not look at them.
std::vector<Part> boxes_around(const Shape& shape) {
  std::vector<Part> parts;
  for (Eigen::Index k = 0; k < shape.part_count(); ++k)
    parts.push_back({shape.part_names[static_cast<std::size_t>(k)],
                     cuboid_of(axis_aligned_box(extract_part(shape, k).vertices)),
                     {}});
  return parts;
}

std::vector<Relation> joints_of(const Shape& shape, const JointOptions& options = {}) {
  return find_joints(shape, boxes_around(shape), options);
}

void check_points(const Relation& joint, const std::vector<Eigen::Vector3d>& wanted, double margin) {
  REQUIRE(joint.points.rows() == static_cast<Eigen::Index>(wanted.size()));
  for (std::size_t k = 0; k < wanted.size(); ++k)
    CHECK((joint.points.row(static_cast<Eigen::Index>(k)).transpose() - wanted[k]).norm() < margin);
}

/// A half ring with square ends on x = 0, around the y axis, radii 2 and 3, half of it at z > 0.
Shape half_ring() {
  solids::Polygon profile;
  for (int k = 0; k <= 16; ++k) profile.push_back(3 * solids::circle_point(k, 32).reverse());
  for (int k = 16; k >= 0; --k) profile.push_back(2 * solids::circle_point(k, 32).reverse());
  std::reverse(profile.begin(), profile.end());
  return solids::extruded_profile(profile, 1);
}

GeneralizedCylinder half_ring_curve() {
  GeneralizedCylinder cylinder;
  cylinder.centres.resize(17, 3);
  cylinder.radii.setConstant(17, 0.5);
  for (int k = 0; k <= 16; ++k) {
    const Eigen::Vector2d p = 2.5 * solids::circle_point(k, 32);
    cylinder.centres.row(k) << p.y(), 0.5, p.x();
  }
  return cylinder;
}

}  // namespace

TEST_CASE("a leg flush under a plate has a point joint at the middle of its top, however fine the mesh") {
  for (int level = 0; level < 4; ++level) {
    const Shape shape = solids::joined({solids::finely(solids::box({0, 0, 4}, {10, 10, 5}), 3 - level),
                                        solids::finely(solids::box({2, 3, 0}, {3, 4, 4}), level)});
    const std::vector<Relation> joints = joints_of(shape);
    REQUIRE(joints.size() == 1);
    CHECK(joints[0].type == RelationType::point_joint);
    CHECK(joints[0].parts == std::vector<int>{0, 1});
    CHECK(joints[0].residual == Approx(0).margin(1e-12));
    check_points(joints[0], {{2.5, 3.5, 4}}, 1e-9);
  }
}

TEST_CASE("gap, overlap, piercing and containment all give one joint in the middle of what is shared") {
  const Shape plate = solids::box({-5, -5, 4}, {5, 5, 5});
  struct Case {
    double bottom, top, height;
  };
  for (const Case& one :
       {Case{0, 3.95, 3.975}, Case{0, 4.5, 4.25}, Case{0, 5, 4.5}, Case{0, 7, 4.5}, Case{4.25, 4.75, 4.5}})
    for (int level = 0; level < 3; level += 2) {
      const Shape shape =
          solids::joined({plate, solids::finely(solids::box({1, 2, one.bottom}, {2, 3, one.top}), level)});
      const std::vector<Relation> joints = joints_of(shape);
      INFO("from " << one.bottom << " to " << one.top << ", level " << level);
      REQUIRE(joints.size() == 1);
      CHECK(joints[0].type == RelationType::point_joint);
      INFO(joints[0].points);
      check_points(joints[0], {{1.5, 2.5, one.height}}, 1e-9);
    }
}

TEST_CASE("a gap wider than the reach is no joint") {
  const Shape plate = solids::box({-5, -5, 4}, {5, 5, 5});
  CHECK(joints_of(solids::joined({plate, solids::box({1, 2, 0}, {2, 3, 3.7})})).empty());
  CHECK(joints_of(solids::joined({plate, solids::box({1, 2, 0}, {2, 3, 3.7})}), {.reach = 0.05}).size() == 1);
}

TEST_CASE("two boxes that share an edge have a line joint with exactly its ends") {
  const Shape shape = solids::joined({solids::box({0, 0, 0}, {1, 8, 1}), solids::box({1, 1, 1}, {2, 7, 2})});
  const std::vector<Relation> joints = joints_of(shape);
  REQUIRE(joints.size() == 1);
  CHECK(joints[0].type == RelationType::line_joint);
  check_points(joints[0], {{1, 1, 1}, {1, 7, 1}}, 1e-9);
}

TEST_CASE("a rail under a plate has a line joint along its middle, and the ends of a short one are a point") {
  const Shape plate = solids::box({-10, -10, 0}, {10, 10, 1});
  const std::vector<Relation> line =
      joints_of(solids::joined({plate, solids::box({-6, 2, -1}, {6, 2.5, 0})}));
  REQUIRE(line.size() == 1);
  CHECK(line[0].type == RelationType::line_joint);
  check_points(line[0], {{-6, 2.25, 0}, {6, 2.25, 0}}, 1e-9);
  const std::vector<Relation> point =
      joints_of(solids::joined({plate, solids::box({-0.5, 2, -4}, {0.5, 2.125, 0})}));
  REQUIRE(point.size() == 1);
  CHECK(point[0].type == RelationType::point_joint);
}

TEST_CASE("a rim on a cup is joined at four sides of the ring, not at the middle of nothing") {
  const solids::Polygon wall = {{0, 0}, {3, 0}, {3, 5}, {2.75, 5}, {2.75, 0.25}, {0, 0.25}};
  const solids::Polygon ring = {{2.5, 5}, {3.25, 5}, {3.25, 5.5}, {2.5, 5.5}};
  const std::vector<Relation> joints = joints_of(
      solids::joined({solids::surface_of_revolution(wall, 32), solids::surface_of_revolution(ring, 32)}));
  REQUIRE(joints.size() == 4);
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  for (const Relation& joint : joints) {
    CHECK(joint.type == RelationType::point_joint);
    REQUIRE(joint.points.rows() == 1);
    const Eigen::Vector3d point = joint.points.row(0).transpose();
    CHECK(point.z() == Approx(5));
    CHECK(point.head<2>().norm() == Approx(3).epsilon(1e-9));
    CHECK(point.head<2>().cwiseAbs().minCoeff() == Approx(0).margin(1e-9));
    sum += point;
  }
  CHECK(sum.head<2>().norm() == Approx(0).margin(1e-9));
  // The sides follow the shape: here along and across the direction of a knob.
  const Shape knobbed =
      solids::joined({solids::surface_of_revolution(wall, 32), solids::surface_of_revolution(ring, 32),
                      solids::box({3, -1, 1}, {6, 1, 2})});
  const Eigen::Matrix3d turn = Eigen::AngleAxisd(0.4, Eigen::Vector3d(1, 2, 2) / 3).toRotationMatrix();
  for (const Shape& shape : {knobbed, transformed(knobbed, turn, {1, 2, 3})}) {
    int along = 0;
    for (const Relation& joint : joints_of(shape)) {
      if (joint.parts != std::vector<int>{0, 1}) continue;
      Eigen::Vector3d point = joint.points.row(0).transpose();
      if (shape.vertices != knobbed.vertices) point = turn.transpose() * (point - Eigen::Vector3d(1, 2, 3));
      CHECK(point.head<2>().cwiseAbs().minCoeff() == Approx(0).margin(1e-9));
      CHECK(point.head<2>().norm() == Approx(3).epsilon(1e-9));
      ++along;
    }
    CHECK(along == 4);
  }
  // A tube on a plate meets it in a ring as well, but is thin enough to stand on one point.
  const solids::Polygon tube = {{0.5, 0}, {0.75, 0}, {0.75, 20}, {0.5, 20}};
  CHECK(joints_of(
            solids::joined({solids::box({-9, -9, -1}, {9, 9, 0}), solids::surface_of_revolution(tube, 16)}))
            .size() == 1);
}

TEST_CASE("a handle on a body has two point joints, flush or grown into it") {
  for (const double depth : {0.0, 0.25}) {
    const Shape shape = solids::joined({solids::box({-4, -1, -5}, {depth, 2, 5}), half_ring()});
    std::vector<Part> parts = boxes_around(shape);
    parts[1].primitive = half_ring_curve();
    const std::vector<Relation> joints = find_joints(shape, parts);
    REQUIRE(joints.size() == 2);
    for (int k = 0; k < 2; ++k) {
      CHECK(joints[static_cast<std::size_t>(k)].type == RelationType::point_joint);
      CHECK(joints[static_cast<std::size_t>(k)].points(0, 1) == Approx(0.5));
    }
    CHECK(joints[0].points(0, 2) == Approx(-joints[1].points(0, 2)));
    if (depth == 0) CHECK(std::abs(joints[0].points(0, 2)) == Approx(2.5));
  }
}

TEST_CASE("a cuboid that hangs on pegs has a line joint, a bar between two arms has two points") {
  const Shape plate = solids::box({-10, -10, 0}, {10, 10, 1}), rail = solids::box({-6, 2, -3}, {6, 3, -2});
  const Shape pegs =
      solids::joined({solids::box({-5, 2, -2}, {-4, 3, 0.5}), solids::box({4, 2, -2}, {5, 3, 0.5}), rail});
  const Shape hung = solids::joined({plate, make_shape(pegs.vertices, pegs.triangles)});
  const std::vector<Relation> line = joints_of(hung);
  REQUIRE(line.size() == 1);
  CHECK(line[0].type == RelationType::line_joint);
  check_points(line[0], {{-5, 2.5, 0.25}, {5, 2.5, 0.25}}, 1e-9);

  const Shape arms = solids::joined({solids::box({-7, 0, 0}, {-6, 1, 8}), solids::box({6, 0, 0}, {7, 1, 8}),
                                     solids::box({-7, 0, -1}, {7, 1, 0})});
  const Shape held =
      solids::joined({make_shape(arms.vertices, arms.triangles), solids::box({-6, 0, 5}, {6, 1, 6})});
  const std::vector<Relation> points = joints_of(held);
  REQUIRE(points.size() == 2);
  CHECK(points[0].type == RelationType::point_joint);
  check_points(points[0], {{-6, 0.5, 5.5}}, 1e-9);
  check_points(points[1], {{6, 0.5, 5.5}}, 1e-9);
}

TEST_CASE("open surfaces meet as well") {
  // A leg without its top and bottom, its rim on a plate that is one layer of triangles.
  Shape leg = solids::box({1, 1, 0}, {2, 2, 4});
  std::vector<Eigen::Index> walls;
  for (Eigen::Index t = 0; t < leg.triangle_count(); ++t)
    if (leg.corner(t, 0).z() != leg.corner(t, 1).z() || leg.corner(t, 0).z() != leg.corner(t, 2).z())
      walls.push_back(t);
  leg = make_shape(leg.vertices, leg.triangles(walls, Eigen::all));
  Points corners(4, 3);
  corners << 0, 0, 4, 9, 0, 4, 9, 9, 4, 0, 9, 4;
  Triangles two(2, 3);
  two << 0, 1, 2, 0, 2, 3;
  const std::vector<Relation> joints = joints_of(solids::joined({leg, make_shape(corners, two)}));
  REQUIRE(joints.size() == 1);
  check_points(joints[0], {{1.5, 1.5, 4}}, 1e-9);
}

TEST_CASE("bars that overlap inside a leg are joined to the leg alone") {
  const Shape leg = solids::box({0, 0, 0}, {2, 2, 10}), along_x = solids::box({0.5, 0.5, 4}, {9, 1.5, 5});
  const Shape along_y = solids::box({0.5, 0.5, 4}, {1.5, 9, 5});
  const std::vector<Relation> joints = joints_of(solids::joined({leg, along_x, along_y}));
  REQUIRE(joints.size() == 2);
  CHECK(joints[0].parts == std::vector<int>{0, 1});
  CHECK(joints[1].parts == std::vector<int>{0, 2});
  check_points(joints[0], {{1.25, 1, 4.5}}, 1e-9);
  CHECK(joints_of(solids::joined({along_x, along_y})).size() == 1);
}

TEST_CASE("joints move with the shape, in any pose and at any scale") {
  solids::Random random(11);
  const Shape shape =
      solids::joined({solids::box({-4, -1, -5}, {0.25, 2, 5}), solids::finely(half_ring(), 1),
                      solids::box({-4, -8, 5}, {0, 8, 5.5}), solids::box({-3, -9, -5}, {-2, -1, -4})});
  const auto joints_with_handle = [](const Shape& one) {
    std::vector<Part> parts = boxes_around(one);
    parts[1].primitive = half_ring_curve();  // of closed surfaces only the kind matters
    return find_joints(one, parts);
  };
  const std::vector<Relation> rest = joints_with_handle(shape);
  REQUIRE(rest.size() == 4);
  for (int round = 0; round < 8; ++round) {
    const double scale = std::pow(10, random.uniform(-4, 4));
    const Eigen::Matrix3d turn =
        Eigen::AngleAxisd(random.uniform(-3, 3), random.on_sphere()).toRotationMatrix();
    const Eigen::Vector3d shift = 30 * scale * random.in_cube();
    const Shape posed = transformed(shape, scale * turn, shift);
    const std::vector<Relation> found = joints_with_handle(posed);
    REQUIRE(found.size() == rest.size());
    for (const Relation& joint : found) {
      double nearest = 1e9;
      for (const Relation& old : rest) {
        if (old.type != joint.type || old.parts != joint.parts) continue;
        Points image = (scale * old.points * turn.transpose()).rowwise() + shift.transpose();
        const double ahead = (image - joint.points).norm();
        image = image.colwise().reverse().eval();
        nearest = std::min({nearest, ahead, (image - joint.points).norm()});
      }
      CHECK(nearest / scale < 1e-9 * 20);
    }
  }
}

TEST_CASE("options out of range are refused") {
  const Shape shape = solids::table({});
  CHECK(joints_of(shape).size() == 4);
  CHECK_THROWS_AS(joints_of(shape, {.reach = 0}), UsageError);
  CHECK_THROWS_AS(joints_of(shape, {.separate = -1}), UsageError);
  CHECK_THROWS_AS(joints_of(shape, {.line_aspect = 0.5}), UsageError);
  CHECK_THROWS_AS(joints_of(shape, {.min_line = -1}), UsageError);
  CHECK_THROWS_AS(find_joints(shape, {}), UsageError);
}
