#include <Eigen/LU>
#include <cmath>

#include "stackabilization/core/errors.h"
#include "stackabilization/deformation/factory.h"
#include "stackabilization/improvement/carried_design.h"
#include "stackabilization/improvement/energy.h"
#include "support/catch.h"
#include "support/structures.h"

using namespace stackabilization;

TEST_CASE("a mesh at rest is the design at rest: D is 0 to the bit") {
  const StructuredShape table = structures::table(1);
  const Design design = carried_design(table, table.shape);
  CHECK(design.edits.empty());
  CHECK(EnergyMeter(table, BoxModel::frame).distortion(design).total() == 0);
}

TEST_CASE("primitives follow an affine map of the mesh") {
  const StructuredShape table = structures::table(1);
  Eigen::Matrix3d map;
  map << 1.2, 0.1, 0, 0, 0.9, 0.2, 0.05, 0, 1.4;
  const Design design = carried_design(table, transformed(table.shape, map, Eigen::Vector3d::Zero()));
  REQUIRE(design.primitives.size() == table.structure.parts.size());
  for (std::size_t part = 0; part < design.primitives.size(); ++part) {
    const Points rest = control_points(table.structure.parts[part].primitive);
    const Points now = control_points(design.primitives[part]);
    CHECK((now - rest * map.transpose()).cwiseAbs().maxCoeff() < 1e-9);
  }
  // Eq. 7: every volume grows by the determinant.
  CHECK(EnergyMeter(table, BoxModel::frame).distortion(design).volume ==
        Approx(std::abs(map.determinant() - 1)).epsilon(1e-6));
}

TEST_CASE("the same primitives as those of a model that carries them along") {
  const StructuredShape table = structures::table(1);
  const auto space = deformation_model(table, {DeformationKind::surface, Direction(0, 0, 1)});
  const Edit edit{{HandleKind::part, 0, 0}, Move{{0, 0, 0.3}}};
  const DeformationResult outcome = space->edited(space->at_rest(), edit, {});
  REQUIRE_FALSE(outcome.refusal);
  const Design design = carried_design(table, outcome.design.shape);
  const EnergyMeter meter(table, BoxModel::frame);
  CHECK(meter.distortion(outcome.design).total() > 0);
  for (std::size_t part = 0; part < design.primitives.size(); ++part)
    CHECK(control_points(design.primitives[part]) == control_points(outcome.design.primitives[part]));
}

TEST_CASE("another mesh is refused") {
  const StructuredShape table = structures::table(1);
  Shape fewer = table.shape;
  fewer.triangles.conservativeResize(fewer.triangles.rows() - 1, 3);
  fewer.triangle_part.pop_back();
  CHECK_THROWS_AS(carried_design(table, fewer), UsageError);
  Shape other = table.shape;
  std::swap(other.triangles(0, 0), other.triangles(0, 1));
  CHECK_THROWS_AS(carried_design(table, other), UsageError);
}
