#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "deformation/controllers/mesh_transfer.h"
#include "support/catch.h"
#include "support/structures.h"
#include "support/variants.h"

namespace stackabilization::mesh_transfer_test {

using namespace detail;

namespace {

constexpr double step = 0.125;
constexpr int steps = 32;  ///< on either side

/// A sheet [-4, 4] x [0, 1] at z = 0 whose halves are the parts "left" and "right", each within a cuboid that
/// is 1 thick. They share the vertices at x = 0. The last vertex is used by no triangle.
StructuredShape sheet() {
  StructuredShape rest;
  Shape& shape = rest.shape;
  shape.vertices.resize(2 * (2 * steps + 1) + 1, 3);
  shape.triangles.resize(4 * steps, 3);
  for (int i = 0; i <= 2 * steps; ++i)
    for (int j = 0; j < 2; ++j) shape.vertices.row(2 * i + j) << step * (i - steps), j, 0;
  shape.vertices.bottomRows<1>() << 0.5, 0.5, 0.25;
  for (int i = 0; i < 2 * steps; ++i) {
    shape.triangles.row(2 * i) << 2 * i, 2 * i + 2, 2 * i + 3;
    shape.triangles.row(2 * i + 1) << 2 * i, 2 * i + 3, 2 * i + 1;
    shape.triangle_part.insert(shape.triangle_part.end(), 2, i < steps ? 0 : 1);
  }
  shape.part_names = {"left", "right"};
  rest.structure.diagonal = std::sqrt(65.0);
  for (const double middle : {-2.0, 2.0})
    rest.structure.parts.push_back({middle < 0 ? "left" : "right",
                                    cuboid_of({{middle, 0.5, 0}, Eigen::Matrix3d::Identity(), {2, 0.5, 0.5}}),
                                    {}});
  return rest;
}

std::vector<Primitive> primitives_of(const Structure& structure) {
  std::vector<Primitive> primitives;
  for (const Part& part : structure.parts) primitives.push_back(part.primitive);
  return primitives;
}

void shift(Primitive& primitive, const Eigen::RowVector3d& by) {
  std::get<Cuboid>(primitive).corners.rowwise() += by;
}

/// The smooth step from 1 at 0 to 0 at 1.
double fall_off(double t) {
  return t >= 1 ? 0 : 1 - 3 * t * t + 2 * t * t * t;
}

/// Share of the other part in a vertex at this distance from the border along the edges: 0.15 of the diagonal
/// of a half is the reach, within which the weight falls from 1 by a smooth step; then both are divided by
/// their sum.
double share_of_other(double distance) {
  const double weight = fall_off(distance / (0.15 * std::sqrt(17.0)));
  return weight / (1 + weight);
}

/// The weight of a point that counts in all directions alike.
double weight_of(const BoundPoint& bound) {
  CHECK(bound.weight == bound.weight(0, 0) * Eigen::Matrix3d::Identity());
  return bound.weight(0, 0);
}

/// The sheet, whose left half is a post along y and whose right half a rail that ends at its side, half-way
/// or near its upper end. The joint slides along the post.
StructuredShape post_and_rail(double middle_of_post = 0.5) {
  StructuredShape rest = sheet();
  rest.structure.parts[0].primitive =
      cuboid_of({{-2, middle_of_post, 0}, Eigen::Matrix3d::Identity(), {2, 8, 0.5}});
  Relation joint;
  joint.type = RelationType::point_joint;
  joint.parts = {0, 1};
  joint.points = Points::Zero(1, 3);
  joint.points << 0, 0.5, 0;
  joint.carrier = 0;
  joint.sliding = {{false, true, false}};
  rest.structure.relations = {joint};
  return rest;
}

}  // namespace

TEST_CASE("beyond a border the share of the other part falls off by a smooth step along the edges") {
  const StructuredShape rest = sheet();
  const Rig rig(rest.structure);
  const MeshTransfer transfer(rest.shape, rig);
  int shared = 0;
  for (int v = 0; v < 2 * (2 * steps + 1); ++v) {
    const double x = rest.shape.vertices(v, 0), other = share_of_other(std::abs(x));
    const std::vector<BoundPoint> bound_points = transfer.bound_points(v);
    INFO("x = " << x);
    REQUIRE(bound_points.size() == (other > 0 ? 2u : 1u));
    shared += other > 0 ? 1 : 0;
    double sum = 0;
    for (const BoundPoint& bound : bound_points) {
      const bool own = x == 0 || bound.part == (x < 0 ? 0 : 1);
      CHECK(weight_of(bound) == Approx(own ? 1 - other : other).epsilon(1e-12));
      sum += weight_of(bound);
    }
    CHECK(sum == Approx(1).epsilon(1e-15));
  }
  CHECK(shared == 2 * 9);  // x = 0 and four steps on either side
}

TEST_CASE("a vertex that parts share is carried by them alike") {
  // Three triangles around one vertex, each its own part.
  StructuredShape rest;
  rest.shape.vertices.resize(4, 3);
  rest.shape.vertices << 0, 0, 0, 4, 0, 0, 0, 4, 0, -4, -4, 0;
  rest.shape.triangles.resize(3, 3);
  rest.shape.triangles << 0, 1, 2, 0, 2, 3, 0, 3, 1;
  rest.shape.triangle_part = {0, 1, 2};
  rest.shape.part_names = {"a", "b", "c"};
  rest.structure.diagonal = 12;
  for (const std::string& name : rest.shape.part_names)
    rest.structure.parts.push_back(
        {name, cuboid_of({{0, 0, 0}, Eigen::Matrix3d::Identity(), {4, 4, 1}}), {}});
  const Rig rig(rest.structure);
  const MeshTransfer transfer(rest.shape, rig);
  REQUIRE(transfer.bound_points(0).size() == 3);
  for (const BoundPoint& bound : transfer.bound_points(0))
    CHECK(weight_of(bound) == Approx(1.0 / 3).epsilon(1e-14));
  std::vector<Primitive> now = primitives_of(rest.structure);
  shift(now[1], {0, 0, 0.3});
  CHECK(transfer.vertices(rig, now)(0, 2) == Approx(0.1).epsilon(1e-13));
}

TEST_CASE("in smooth designs a border follows the part that does not end there") {
  // With a joint that slides along the post, and without, where the places of the border on both parts tell.
  const auto [middle, slides] = GENERATE(table<double, bool>({{0.5, true}, {0.5, false}, {-6.5, false}}));
  StructuredShape rest = post_and_rail(middle);
  if (!slides) rest.structure.relations.clear();
  const Rig rig(rest.structure);
  const MeshTransfer transfer(rest.shape, rig, Following::smooth);
  std::vector<Primitive> now = primitives_of(rest.structure);
  // What both parts do, the border does; a rail that gets wider leaves it as it is.
  for (Primitive& primitive : now) shift(primitive, {0.1, 0.2, 0.3});
  const Points shifted = transfer.vertices(rig, now);
  now = primitives_of(rest.structure);
  auto& corners = std::get<Cuboid>(now[1]).corners;
  corners.col(1).array() = 0.5 + 1.5 * (corners.col(1).array() - 0.5);
  const Points widened = transfer.vertices(rig, now);
  for (int v = 0; v < 2 * (2 * steps + 1); ++v) {
    const Eigen::RowVector3d at_rest = rest.shape.vertices.row(v);
    CHECK((shifted.row(v) - at_rest - Eigen::RowVector3d(0.1, 0.2, 0.3)).norm() < 1e-14);
    CHECK(widened(v, 1) - 0.5 == Approx((at_rest.x() <= 0 ? 1 : 1.5) * (at_rest.y() - 0.5)));
  }
}

TEST_CASE(
    "in smooth designs a vertex of three parts follows the one that is attached to none of the others") {
  // Around vertex 0: a board, a leg that is attached to it, and a beam that is attached to both. Vertex 4 is
  // on the border of board and beam, near the leg.
  StructuredShape rest;
  rest.shape.vertices.resize(5, 3);
  rest.shape.vertices << 0, 0, 0, 4, 0, 0, 0, 4, 0, -4, -4, 0, 0.05, 0, 0;
  rest.shape.triangles.resize(5, 3);
  rest.shape.triangles << 0, 4, 2, 4, 1, 2, 0, 2, 3, 0, 3, 4, 4, 3, 1;
  rest.shape.triangle_part = {0, 0, 1, 2, 2};
  rest.shape.part_names = {"board", "leg", "beam"};
  rest.structure.diagonal = 12;
  for (const std::string& name : rest.shape.part_names)
    rest.structure.parts.push_back(
        {name, cuboid_of({{0, 0, 0}, Eigen::Matrix3d::Identity(), {4, 4, 1}}), {}});
  const auto join = [&](int carrier, int attached, const Eigen::RowVector3d& point) {
    Relation joint;
    joint.type = RelationType::point_joint;
    joint.parts = {carrier, attached};
    joint.points = point;
    joint.carrier = carrier;
    joint.sliding = {{true, true, false}};
    rest.structure.relations.push_back(joint);
  };
  join(0, 1, {0, 2, 0});
  join(0, 2, {2, 0, 0});
  join(1, 2, {-2, -2, 0});
  const Rig rig(rest.structure);
  std::vector<Primitive> now = primitives_of(rest.structure);
  // The leg leans about the middle of its border with the board.
  auto& corners = std::get<Cuboid>(now[1]).corners;
  const Eigen::RowVector3d joint(0, 2, 0);
  const Eigen::Matrix3d turn =
      Eigen::AngleAxisd(0.3, Eigen::Vector3d(1, 0, 1).normalized()).toRotationMatrix();
  corners = (((corners.rowwise() - joint) * turn.transpose()).rowwise() + joint).eval();
  const Points moved = MeshTransfer(rest.shape, rig, Following::smooth).vertices(rig, now);
  for (const int vertex : {0, 1, 2, 4})
    CHECK((moved.row(vertex) - rest.shape.vertices.row(vertex)).norm() < 1e-14);
  CHECK((moved.row(3) - rest.shape.vertices.row(3)).norm() > 0.5);
}

TEST_CASE("in smooth designs two halves that meet end to end own their border together") {
  const StructuredShape halves = sheet();
  const MeshTransfer both(halves.shape, Rig(halves.structure), Following::smooth);
  REQUIRE(both.bound_points(2 * steps).size() == 2);
  CHECK(weight_of(both.bound_points(2 * steps)[0]) == 0.5);
}

TEST_CASE("in smooth designs the smaller of two parts that meet end to end follows the larger one") {
  StructuredShape rest = sheet();
  Shape& shape = rest.shape;
  for (Eigen::Index t = 0; t < shape.triangle_count(); ++t)
    if (shape.corner(t, 0).x() >= 1 && shape.corner(t, 1).x() >= 1 && shape.corner(t, 2).x() >= 1)
      shape.triangle_part[static_cast<std::size_t>(t)] = 2;
  shape.part_names.push_back("far");
  rest.structure.parts[1].primitive =
      cuboid_of({{0.5, 0.5, 0}, Eigen::Matrix3d::Identity(), {0.5, 0.5, 0.5}});
  rest.structure.parts.push_back(
      {"far", cuboid_of({{2.5, 0.5, 0}, Eigen::Matrix3d::Identity(), {1.5, 0.5, 0.5}}), {}});
  const Rig rig(rest.structure);
  std::vector<Primitive> now = primitives_of(rest.structure);
  auto& corners = std::get<Cuboid>(now[1]).corners;
  corners.col(1).array() = 0.5 + 1.5 * (corners.col(1).array() - 0.5);
  const Points widened = MeshTransfer(shape, rig, Following::smooth).vertices(rig, now);
  for (int v = 0; v < 2 * (2 * steps + 1); ++v) {
    const double x = shape.vertices(v, 0), y = shape.vertices(v, 1);
    const bool is_within = x > 0.125 && x < 0.875;
    if (x <= 0 || x >= 1 || is_within)
      CHECK(widened(v, 1) - 0.5 == Approx((is_within ? 1.5 : 1) * (y - 0.5)));
  }
}

TEST_CASE("a seam that slides takes the surface of its carrier along, by a smooth step along the edges") {
  const StructuredShape rest = post_and_rail();
  const Rig rig(rest.structure);
  const MeshTransfer transfer(rest.shape, rig, Following::smooth);
  std::vector<Primitive> now = primitives_of(rest.structure);
  shift(now[1], {0, 0.1, 0});
  const Points moved = transfer.vertices(rig, now);
  for (int v = 0; v < 2 * (2 * steps + 1); ++v) {
    const double x = rest.shape.vertices(v, 0), reach = 0.2 * std::sqrt(17.0);
    const double share = x > 0 ? 1 : fall_off(-x / reach);
    INFO("x = " << x);
    CHECK((moved.row(v) - rest.shape.vertices.row(v) - share * Eigen::RowVector3d(0, 0.1, 0)).norm() < 1e-13);
  }
}

TEST_CASE("all of a curved part slides, however short its seam") {
  StructuredShape rest = post_and_rail();
  rest.shape.vertices.col(1) *= 0.1;
  // An arc that rises from the sheet: it gives way to the post within 0.4, and its seam is 0.1 long.
  GeneralizedCylinder arc = structures::arc_cylinder(3, 0.3, 0.2, 1.4, 8);
  rest.structure.parts[1].primitive = arc;
  const Rig rig(rest.structure);
  const MeshTransfer transfer(rest.shape, rig, Following::smooth);
  std::vector<Primitive> now = primitives_of(rest.structure);
  std::get<GeneralizedCylinder>(now[1]).centres.col(1).array() += 0.1;
  const Points moved = transfer.vertices(rig, now);
  for (int v = 2 * steps; v < 2 * (2 * steps + 1); ++v) {
    INFO("x = " << rest.shape.vertices(v, 0));
    CHECK((moved.row(v) - rest.shape.vertices.row(v) - Eigen::RowVector3d(0, 0.1, 0)).norm() < 1e-12);
  }
}

TEST_CASE("a part whose border has two pieces slides once") {
  // Rows of vertices at y = 0, 0.05 and 0.1; on the right no triangle has the one in the middle of the
  // border.
  StructuredShape rest = post_and_rail();
  Shape& shape = rest.shape;
  const auto row = [](int i, int j) { return 3 * i + j; };
  shape.vertices.resize(3 * (2 * steps + 1), 3);
  for (int i = 0; i <= 2 * steps; ++i)
    for (int j = 0; j < 3; ++j) shape.vertices.row(row(i, j)) << step * (i - steps), 0.05 * j, 0;
  std::vector<std::array<int, 3>> triangles;
  shape.triangle_part.clear();
  const auto add = [&](int i, std::array<int, 3> triangle) {
    if (i >= steps && std::ranges::count(triangle, row(steps, 1)) > 0) return;
    triangles.push_back(triangle);
    shape.triangle_part.push_back(i < steps ? 0 : 1);
  };
  for (int i = 0; i < 2 * steps; ++i) {
    add(i, {row(i, 0), row(i + 1, 0), row(i + 1, 1)});
    add(i, {row(i, 0), row(i + 1, 1), row(i, 1)});
    add(i, {row(i, 1), row(i + 1, 1), row(i, 2)});
    add(i, {row(i, 2), row(i + 1, 1), row(i + 1, 2)});
  }
  shape.triangles.resize(static_cast<Eigen::Index>(triangles.size()), 3);
  for (std::size_t t = 0; t < triangles.size(); ++t)
    shape.triangles.row(static_cast<Eigen::Index>(t)) << triangles[t][0], triangles[t][1], triangles[t][2];
  rest.structure.parts[1].primitive = structures::arc_cylinder(3, 0.3, 0.2, 1.4, 8);
  const Rig rig(rest.structure);
  std::vector<Primitive> now = primitives_of(rest.structure);
  std::get<GeneralizedCylinder>(now[1]).centres.col(1).array() += 0.1;
  const Points moved = MeshTransfer(shape, rig, Following::smooth).vertices(rig, now);
  for (int i = steps + 1; i <= 2 * steps; ++i)
    for (int j = 0; j < 3; ++j)
      CHECK(moved(row(i, j), 1) - shape.vertices(row(i, j), 1) == Approx(0.1).epsilon(1e-9));
  for (const int j : {0, 2})
    CHECK(moved(row(steps, j), 1) - shape.vertices(row(steps, j), 1) == Approx(0.1).epsilon(1e-9));
}

TEST_CASE("what lies across the slide of a seam stays, as the rim of a cup above its handle") {
  // From x = -0.5 on the sheet turns its face towards y, the direction of the slide, within the reach of
  // 0.82.
  StructuredShape rest = post_and_rail();
  const auto x_of = [](int v) { return step * (v / 2 - steps); };
  for (int v = 0; v < 2 * (2 * steps + 1); ++v)
    if (x_of(v) <= -0.5) rest.shape.vertices.row(v) << x_of(v), 0, v % 2;
  const Rig rig(rest.structure);
  std::vector<Primitive> now = primitives_of(rest.structure);
  shift(now[1], {0, 0.1, 0});
  const Points moved = MeshTransfer(rest.shape, rig, Following::smooth).vertices(rig, now);
  for (int v = 0; v < 2 * (2 * steps + 1); ++v) {
    const double by = moved(v, 1) - rest.shape.vertices(v, 1);
    INFO("x = " << x_of(v));
    if (x_of(v) <= -0.5) CHECK(by == 0);
    if (x_of(v) >= -0.25) CHECK(by > 0.05);
  }
}

TEST_CASE("a rail that turns is trimmed to its carrier along its sides") {
  const StructuredShape rest = post_and_rail();
  const Rig rig(rest.structure);
  const MeshTransfer transfer(rest.shape, rig, Following::smooth);
  const double angle = 0.3;
  const Eigen::Matrix3d turn = Eigen::AngleAxisd(angle, Eigen::Vector3d::UnitZ()).toRotationMatrix();
  const Eigen::RowVector3d joint(0, 0.5, 0);
  std::vector<Primitive> now = primitives_of(rest.structure);
  auto& corners = std::get<Cuboid>(now[1]).corners;
  corners = (((corners.rowwise() - joint) * turn.transpose()).rowwise() + joint).eval();
  const Points moved = transfer.vertices(rig, now);
  for (int v = 0; v < 2 * (2 * steps + 1); ++v) {
    const Eigen::RowVector3d at_rest = rest.shape.vertices.row(v) - joint;
    INFO("x = " << at_rest.x());
    if (at_rest.x() <= 0) {
      CHECK((moved.row(v) - joint - at_rest).norm() < 1e-14);
      continue;
    }
    // In the frame of the rail its sides stay where they were, and vertices lie on them nearer to where the
    // post would have them, within the reach of 0.82: less than the length of the seam.
    const Eigen::RowVector3d in_rail = (moved.row(v) - joint) * turn;
    CHECK(in_rail.y() == Approx(at_rest.y()).epsilon(1e-12));
    const double by_post = (at_rest * turn).x(), share = fall_off(at_rest.x() / (0.2 * std::sqrt(17.0)));
    CHECK(in_rail.x() == Approx(share * by_post + (1 - share) * at_rest.x()).epsilon(1e-12));
  }
}

TEST_CASE("where nothing moved the mesh stays to the last bit") {
  const StructuredShape rest = sheet();
  const Rig rig(rest.structure);
  const MeshTransfer transfer(rest.shape, rig);
  std::vector<Primitive> now = primitives_of(rest.structure);
  CHECK(transfer.rest() == rest.shape.vertices);
  CHECK(transfer.vertices(rig, now) == rest.shape.vertices);
  shift(now[1], {0.1, 0.2, 0.3});
  const Points moved = transfer.vertices(rig, now);
  for (Eigen::Index v = 0; v < moved.rows(); ++v) {
    const double x = rest.shape.vertices(v, 0);
    const bool is_used = v + 1 < moved.rows();
    if (!is_used || x < -0.65) CHECK(moved.row(v) == rest.shape.vertices.row(v));
    if (!is_used) continue;
    const double share = x < 0 ? share_of_other(-x) : 1 - share_of_other(x);
    CHECK((moved.row(v) - rest.shape.vertices.row(v) - share * Eigen::RowVector3d(0.1, 0.2, 0.3)).norm() <
          1e-13);
  }
}

TEST_CASE("an affine map of all cuboids is one of the mesh") {
  solids::Random random(3);
  for (const StructuredShape& rest : {sheet(), structures::table(1)}) {
    const Rig rig(rest.structure);
    const MeshTransfer transfer(rest.shape, rig);
    for (int trial = 0; trial < 5; ++trial) {
      Eigen::Matrix3d linear = Eigen::Matrix3d::Identity();
      for (double& factor : linear.reshaped()) factor += random.uniform(-0.2, 0.2);
      const Eigen::RowVector3d by = random.in_cube().transpose();
      std::vector<Primitive> now = primitives_of(rest.structure);
      for (Primitive& primitive : now) {
        auto& corners = std::get<Cuboid>(primitive).corners;
        corners = ((corners * linear.transpose()).rowwise() + by).eval();
      }
      const Points moved = transfer.vertices(rig, now),
                   expected = (rest.shape.vertices * linear.transpose()).rowwise() + by;
      const Eigen::Index used = rest.shape.triangles.maxCoeff() + 1;
      CHECK((moved - expected).topRows(used).rowwise().norm().maxCoeff() < 1e-11);
    }
  }
}

TEST_CASE("a vertex is the sum of its riders, however its parts deform") {
  solids::Random random(5);
  for (const StructuredShape& rest : {sheet(), structures::mug(12), structures::table(0), post_and_rail()}) {
    const bool smooth = !rest.structure.relations.empty() && rest.structure.relations[0].carrier >= 0;
    const Rig rig(rest.structure);
    const MeshTransfer transfer(rest.shape, rig, smooth ? Following::smooth : Following::free);
    std::vector<Primitive> now = primitives_of(rest.structure);
    for (Primitive& primitive : now) {
      if (smooth)
        shift(primitive, 0.1 * random.in_cube().transpose());  // what is trimmed must not turn
      else if (auto* cuboid = std::get_if<Cuboid>(&primitive))
        for (double& coordinate : cuboid->corners.reshaped()) coordinate += random.uniform(-0.05, 0.05);
      else
        for (double& coordinate : std::get<GeneralizedCylinder>(primitive).centres.reshaped())
          coordinate += random.uniform(-0.05, 0.05);
    }
    const Points moved = transfer.vertices(rig, now);
    for (int v = 0; v <= static_cast<int>(rest.shape.triangles.maxCoeff()); ++v) {
      Eigen::Vector3d sum = Eigen::Vector3d::Zero();
      for (const BoundPoint& bound : transfer.bound_points(v)) {
        const auto part = static_cast<std::size_t>(bound.part);
        sum += bound.weight * rig.primitive_bindings[part].position_of(bound.binding, now[part]);
      }
      REQUIRE((sum - moved.row(v).transpose()).norm() < 1e-12);
    }
  }
}

}  // namespace stackabilization::mesh_transfer_test
