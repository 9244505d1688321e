#include <Eigen/Geometry>
#include <cmath>

#include "stackabilization/core/errors.h"
#include "stackabilization/deformation/rebase.h"
#include "stackabilization/deformation/relation_residual.h"
#include "stackabilization/mesh/boxes.h"
#include "support/catch.h"
#include "support/solids.h"
#include "support/variants.h"

using namespace stackabilization;

namespace {

/// Two boxes on top of each other with a line joint between them, mirrored about x = 1, and a straight
/// cylinder.
StructuredShape tower() {
  StructuredShape tower;
  Shape lower = solids::box({0, 0, 0}, {2, 2, 1}), upper = solids::box({0, 0, 1}, {2, 2, 3}),
        mast = solids::moved(solids::cylinder(0.5, 2, 12), {1, 1, 3});
  lower.part_names = {"lower"};
  upper.part_names = {"upper"};
  mast.part_names = {"mast"};
  tower.shape = concatenate(concatenate(lower, upper), mast);
  GeneralizedCylinder cylinder;
  cylinder.centres.resize(3, 3);
  cylinder.centres << 1, 1, 3, 1, 1, 4, 1, 1, 5;
  cylinder.radii = Eigen::Vector3d::Constant(0.5);
  tower.structure.parts = {{"lower", cuboid_of(axis_aligned_box(lower.vertices)), {}},
                           {"upper", cuboid_of(axis_aligned_box(upper.vertices)), {}},
                           {"mast", cylinder, {}}};
  Symmetry mirror;
  mirror.point = {1, 0, 0};
  tower.structure.symmetries = {mirror};
  Points line(2, 3), spot(1, 3);
  line << 0, 0, 1, 2, 0, 1;
  spot << 1, 1, 3;
  tower.structure.relations = {{RelationType::self_symmetry, {0}, mirror, {}, 0.01},
                               {RelationType::line_joint, {0, 1}, {}, line, 0.02},
                               {RelationType::point_joint, {1, 2}, {}, spot, 0}};
  tower.structure.diagonal = std::sqrt(4 + 4 + 25);
  return tower;
}

/// Everything under p -> a p + t.
Design moved_everywhere(const StructuredShape& rest, double a, const Eigen::Vector3d& t) {
  Design result{{}, {}, transformed(rest.shape, a * Eigen::Matrix3d::Identity(), t)};
  for (const Part& part : rest.structure.parts) {
    Primitive primitive = part.primitive;
    if (auto* cuboid = std::get_if<Cuboid>(&primitive)) {
      cuboid->corners = (a * cuboid->corners).rowwise() + t.transpose();
    } else {
      auto& cylinder = std::get<GeneralizedCylinder>(primitive);
      cylinder.centres = (a * cylinder.centres).rowwise() + t.transpose();
      cylinder.radii *= a;
      cylinder.rotation = Eigen::AngleAxisd(1, Eigen::Vector3d::UnitZ());
    }
    result.primitives.push_back(primitive);
  }
  return result;
}

}  // namespace

TEST_CASE("what nobody moved settles as it was") {
  const StructuredShape rest = tower();
  const StructuredShape now = rebase(rest, moved_everywhere(rest, 1, {0, 0, 0}));
  CHECK(now.structure.diagonal == Approx(rest.structure.diagonal).epsilon(1e-15));
  for (std::size_t k = 0; k < rest.structure.relations.size(); ++k) {
    CHECK(now.structure.relations[k].residual == rest.structure.relations[k].residual);
    if (rest.structure.relations[k].points.rows() > 0)
      CHECK((now.structure.relations[k].points - rest.structure.relations[k].points).norm() < 1e-12);
  }
}

TEST_CASE("joints go where their parts carry them, and turns are forgotten") {
  const StructuredShape rest = tower();
  const Eigen::Vector3d shift(0, 3, -1);
  const StructuredShape now = rebase(rest, moved_everywhere(rest, 2, shift));
  validate(now);
  CHECK(now.structure.diagonal == Approx(2 * rest.structure.diagonal));
  for (const std::size_t k : {1, 2}) {
    const Points expected = (2 * rest.structure.relations[k].points).rowwise() + shift.transpose();
    CHECK((now.structure.relations[k].points - expected).norm() < 1e-12);
  }
  CHECK(std::get<GeneralizedCylinder>(now.structure.parts[2].primitive)
            .rotation.isApprox(Eigen::Quaterniond::Identity()));
  std::vector<Primitive> primitives;
  for (const Part& part : now.structure.parts) primitives.push_back(part.primitive);
  for (const double residual : relation_residuals(now.structure, primitives)) CHECK(residual < 1);
}

TEST_CASE("designs without primitives do not settle") {
  const StructuredShape rest = tower();
  Design design = moved_everywhere(rest, 1, {0, 0, 0});
  design.primitives.clear();
  CHECK_THROWS_AS(rebase(rest, design), UsageError);
}
