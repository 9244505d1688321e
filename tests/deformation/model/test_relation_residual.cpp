#include <cmath>

#include "stackabilization/core/errors.h"
#include "stackabilization/deformation/relation_residual.h"
#include "support/catch.h"
#include "support/structures.h"

using namespace stackabilization;

namespace {

std::vector<Primitive> primitives_of(const Structure& structure) {
  std::vector<Primitive> primitives;
  for (const Part& part : structure.parts) primitives.push_back(part.primitive);
  return primitives;
}

}  // namespace

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
