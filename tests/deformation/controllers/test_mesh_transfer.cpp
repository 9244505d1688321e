#include <cmath>

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

/// Share of the other part in a vertex at this distance from the border along the edges: 0.15 of the diagonal
/// of a half is the reach, within which the weight falls from 1 by a smooth step; then both are divided by
/// their sum.
double share_of_other(double distance) {
  const double t = distance / (0.15 * std::sqrt(17.0));
  const double weight = t >= 1 ? 0 : 1 - 3 * t * t + 2 * t * t * t;
  return weight / (1 + weight);
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
      CHECK(bound.weight == Approx(own ? 1 - other : other).epsilon(1e-12));
      sum += bound.weight;
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
    CHECK(bound.weight == Approx(1.0 / 3).epsilon(1e-14));
  std::vector<Primitive> now = primitives_of(rest.structure);
  shift(now[1], {0, 0, 0.3});
  CHECK(transfer.vertices(rig, now)(0, 2) == Approx(0.1).epsilon(1e-13));
}

TEST_CASE("in smooth designs a border follows the part that does not end there") {
  StructuredShape rest = sheet();
  // The left half is a leg, long along y, and the right half a rail that ends at its side, half-way along the
  // leg or near its upper end.
  for (const double middle : {0.5, -6.5}) {
    rest.structure.parts[0].primitive =
        cuboid_of({{-2, middle, 0}, Eigen::Matrix3d::Identity(), {2, 8, 0.5}});
    const Rig rig(rest.structure);
    const MeshTransfer transfer(rest.shape, rig, Following::smooth);
    for (int v = 0; v < 2 * (2 * steps + 1); ++v) {
      const std::vector<BoundPoint> bound_points = transfer.bound_points(v);
      REQUIRE(bound_points.size() == 1);
      CHECK(bound_points.front().part == (rest.shape.vertices(v, 0) <= 0 ? 0 : 1));
      CHECK(bound_points.front().weight == 1);
    }
  }
  // Two halves that meet end to end own their border together.
  const StructuredShape halves = sheet();
  const MeshTransfer both(halves.shape, Rig(halves.structure), Following::smooth);
  REQUIRE(both.bound_points(2 * steps).size() == 2);
  CHECK(both.bound_points(2 * steps)[0].weight == 0.5);
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
  for (const StructuredShape& rest : {sheet(), structures::mug(12), structures::table(0)}) {
    const Rig rig(rest.structure);
    const MeshTransfer transfer(rest.shape, rig);
    std::vector<Primitive> now = primitives_of(rest.structure);
    for (Primitive& primitive : now) {
      if (auto* cuboid = std::get_if<Cuboid>(&primitive))
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
