#include <Eigen/Geometry>
#include <cmath>

#include "stackabilization/core/errors.h"
#include "stackabilization/deformation/relation_residual.h"
#include "support/catch.h"
#include "support/solids.h"
#include "support/structures.h"

using namespace stackabilization;

namespace {

std::vector<Primitive> primitives_of(const Structure& structure) {
  std::vector<Primitive> primitives;
  for (const Part& part : structure.parts) primitives.push_back(part.primitive);
  return primitives;
}

/// Two unit cubes along x, `gap` apart, joined between their faces.
StructuredShape two_joined(double gap) {
  StructuredShape both;
  Shape other = solids::box({1 + gap, 0, 0}, {2 + gap, 1, 1});
  both.shape = solids::box({0, 0, 0}, {1, 1, 1});
  both.shape.part_names = {"a"};
  other.part_names = {"b"};
  both.shape = concatenate(both.shape, other);
  const Primitive any = cuboid_of({{0, 0, 0}, Eigen::Matrix3d::Identity(), {1, 1, 1}});
  both.structure.parts = {{"a", any, {}}, {"b", any, {}}};
  Relation joint{RelationType::point_joint, {0, 1}, {}, Points(1, 3), 0};
  joint.points << 1 + gap / 2, 0.5, 0.5;
  both.structure.relations = {joint};
  both.structure.diagonal = 2;
  return both;
}

/// The mesh with the vertices of one part displaced.
Shape displaced(const Shape& rest, int part, const Eigen::RowVector3d& by) {
  Shape moved = rest;
  for (Eigen::Index t = 0; t < rest.triangle_count(); ++t)
    if (rest.triangle_part[static_cast<std::size_t>(t)] == part)
      for (int k = 0; k < 3; ++k)
        moved.vertices.row(rest.triangles(t, k)) = rest.vertices.row(rest.triangles(t, k)) + by;
  return moved;
}

}  // namespace

TEST_CASE("at rest every relation holds on the mesh") {
  for (const StructuredShape& rest : {structures::table(), structures::table_with_line_joints(),
                                      structures::mug(), structures::post_with_ring()})
    for (const double residual : mesh_relation_residuals(rest, rest.shape)) CHECK(residual == 0);
}

TEST_CASE("a part that leaves its place is off by its way, as far as the relations tell") {
  const StructuredShape table = structures::table();
  const Eigen::RowVector3d by(-0.25, 0, 0);
  const std::vector<double> residuals = mesh_relation_residuals(table, displaced(table.shape, 1, by));
  for (std::size_t k = 0; k < residuals.size(); ++k) {
    const Relation& relation = table.structure.relations[k];
    const bool of_leg = std::find(relation.parts.begin(), relation.parts.end(), 1) != relation.parts.end();
    INFO(k << ' ' << name_of(relation.type));
    CHECK(residuals[k] == Approx(of_leg ? 0.25 / table.structure.diagonal : 0).margin(1e-15));
  }
}

TEST_CASE("affine maps of everything keep joints, and the symmetries that they commute with") {
  const StructuredShape table = structures::table();
  Eigen::Matrix3d stretch = Eigen::Vector3d(1.5, 0.8, 2).asDiagonal();
  for (const double residual : mesh_relation_residuals(table, transformed(table.shape, stretch, {0, 0, 3})))
    CHECK(residual < 1e-15);
  const Eigen::Matrix3d turn = Eigen::AngleAxisd(0.3, Eigen::Vector3d(1, 2, 3).normalized()).matrix();
  const std::vector<double> turned =
      mesh_relation_residuals(table, transformed(table.shape, turn, {0, 0, 0}));
  for (std::size_t k = 0; k < turned.size(); ++k) {
    const bool is_joint = table.structure.relations[k].is_joint();
    CHECK((is_joint ? turned[k] < 1e-14 : turned[k] > 1e-3));
  }
}

TEST_CASE("parts that slide along each other are joined elsewhere") {
  const StructuredShape both = two_joined(0);
  const auto residual = [&](const Eigen::RowVector3d& by) {
    return mesh_relation_residuals(both, displaced(both.shape, 1, by)).front();
  };
  CHECK(residual({0, 0.5, 0}) == Approx(0.25).epsilon(1e-14));
  CHECK(residual({0.125, 0, 0}) == Approx(0.0625).epsilon(1e-14));
  CHECK(residual({-0.125, 0, 0}) == Approx(0.0625).epsilon(1e-14));
}

TEST_CASE("a gap may stretch to twice its width") {
  const StructuredShape both = two_joined(0.25);
  const auto residual = [&](double wider) {
    return mesh_relation_residuals(both, displaced(both.shape, 1, {wider, 0, 0})).front();
  };
  CHECK(residual(0) == 0);
  CHECK(residual(0.25) == Approx(0).margin(1e-15));
  CHECK(residual(0.375) == Approx(0.0625).epsilon(1e-14));
}

TEST_CASE("a coordinate that is no number is seen, and a part without area is refused") {
  StructuredShape both = two_joined(0);
  Shape broken = both.shape;
  for (int v = 0; v < 8; ++v) broken.vertices.row(v).setConstant(NAN);
  CHECK(std::isnan(mesh_relation_residuals(both, broken).front()));
  for (Eigen::Index v = 8; v < both.shape.vertex_count(); ++v) both.shape.vertices.row(v).setZero();
  CHECK_THROWS_AS(mesh_relation_residuals(both, both.shape), InputError);
}

TEST_CASE("at rest every relation holds") {
  for (const StructuredShape& rest : {structures::table(), structures::table_with_line_joints(),
                                      structures::mug(), structures::post_with_ring()})
    for (const double residual : relation_residuals(rest.structure, primitives_of(rest.structure)))
      CHECK(residual < 1e-15);
}

TEST_CASE("residuals are the distances by which relations are off") {
  const Structure table = structures::table().structure;
  std::vector<Primitive> moved = primitives_of(table);
  std::get<Cuboid>(moved[1]).corners.col(0).array() -= 0.25;  // leg_1, pairs with leg_2 (x) and leg_4 (y)
  const std::vector<double> residuals = relation_residuals(table, moved);
  for (std::size_t k = 0; k < residuals.size(); ++k) {
    const Relation& relation = table.relations[k];
    const bool of_leg = std::find(relation.parts.begin(), relation.parts.end(), 1) != relation.parts.end();
    INFO(k << ' ' << name_of(relation.type));
    CHECK(residuals[k] == Approx(of_leg ? 0.25 / table.diagonal : 0).margin(1e-15));
  }
}

TEST_CASE("radii count, a number that is none is seen, and unlike primitives are named") {
  Structure mug = structures::mug().structure;
  std::vector<Primitive> moved = primitives_of(mug);
  Relation upside_down;
  upside_down.type = RelationType::self_symmetry;
  upside_down.parts = {0};
  upside_down.symmetry.point = {0, 0, 5};
  upside_down.symmetry.axis = {0, 0, 1};
  mug.relations.push_back(upside_down);
  std::get<GeneralizedCylinder>(moved[0]).radii(2) += 0.5;
  CHECK(relation_residuals(mug, moved).back() == Approx(0.5 / mug.diagonal));
  std::get<GeneralizedCylinder>(moved[0]).centres(0, 0) = NAN;
  CHECK(std::isnan(relation_residuals(mug, moved).front()));
  mug.relations.back().parts = {0, 1};
  CHECK_THROWS_AS(relation_residuals(mug, moved), InputError);
}
