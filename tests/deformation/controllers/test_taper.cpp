#include <cmath>

#include "stackabilization/core/errors.h"
#include "stackabilization/deformation/controller_model.h"
#include "stackabilization/deformation/relation_residual.h"
#include "support/catch.h"
#include "support/solids.h"
#include "support/structures.h"

using namespace stackabilization;

namespace {

Edit taper(double factor, const Eigen::Vector3d& axis, std::optional<Eigen::Vector3d> along = {}) {
  return {{HandleKind::shape, 0, 0}, Taper{factor, axis, along}};
}

Design tapered(const StructuredShape& rest, const Edit& edit,
               const DeformationConstraints& constraints = {}) {
  const ControllerModel model(rest, {}, Following::smooth);
  const DeformationResult result = model.edited(model.at_rest(), edit, constraints);
  if (result.refusal) FAIL(describe(*result.refusal, rest.structure));
  for (const double residual : model.relation_residuals(result.design)) CHECK(residual < 1e-6);
  return result.design;
}

/// Corners of a part of the table, lower end first.
Points corners(const StructuredShape& rest, const Design& design, const std::string& part) {
  return structures::cuboid(design.primitives, structures::part_named(rest, part)).corners;
}

double width(const Points& corners, int axis) {
  return corners.col(axis).maxCoeff() - corners.col(axis).minCoeff();
}

}  // namespace

TEST_CASE("A taper of a table leans its legs, keeps their thickness and the top, and stretches the bars",
          "[taper]") {
  const StructuredShape rest = structures::table();
  const Design design = tapered(rest, taper(1.2, {0, 0, -1}));
  const ControllerModel model(rest, {}, Following::smooth);
  const Points before = corners(rest, model.at_rest(), "leg_1"), after = corners(rest, design, "leg_1");
  for (int corner = 0; corner < 8; ++corner) {
    // Closing the joints of bars that lean with the legs takes a little of the height.
    CHECK(after(corner, 2) == Approx(before(corner, 2)).margin(0.01));
    if (before(corner, 2) > 1e-9) continue;
    // The middle of the foot goes out by a fifth.
    const Eigen::RowVector2d foot = before.topRows<4>().leftCols<2>().colwise().mean();
    CHECK((after.row(corner) - before.row(corner)).head<2>().isApprox(0.2 * foot, 0.05));
  }
  CHECK(width(corners(rest, design, "top"), 0) ==
        Approx(width(corners(rest, model.at_rest(), "top"), 0)).epsilon(0.02));
  CHECK(width(corners(rest, design, "bar_1"), 0) + width(corners(rest, design, "bar_1"), 1) >
        width(corners(rest, model.at_rest(), "bar_1"), 0) +
            width(corners(rest, model.at_rest(), "bar_1"), 1));
}

TEST_CASE("A taper along one direction leaves the other one", "[taper]") {
  const StructuredShape rest = structures::table();
  const Design design = tapered(rest, taper(0.8, {0, 0, -1}, Eigen::Vector3d::UnitX()));
  CHECK((design.shape.vertices.col(1) - rest.shape.vertices.col(1)).cwiseAbs().maxCoeff() < 1e-6);
  CHECK((design.shape.vertices.col(0) - rest.shape.vertices.col(0)).cwiseAbs().maxCoeff() > 0.1);
}

TEST_CASE("A tapered cup keeps its rim and its height, and its foot shrinks", "[taper]") {
  const solids::FrustumShell frustum;
  StructuredShape cup{solids::frustum_shell(frustum), {}};
  GeneralizedCylinder cylinder = structures::straight_cylinder({0, 0, 0}, {0, 0, frustum.height}, 1, 24);
  for (Eigen::Index i = 0; i < cylinder.radii.size(); ++i)
    cylinder.radii(i) = frustum.outer_bottom +
                        (frustum.outer_top - frustum.outer_bottom) * cylinder.centres(i, 2) / frustum.height;
  cup.structure.parts = {{cup.shape.part_names.front(), cylinder, {}}};
  cup.structure.diagonal = 10;
  const Design design = tapered(cup, taper(0.9, {0, 0, -1}));
  for (Eigen::Index v = 0; v < cup.shape.vertex_count(); ++v) {
    const Eigen::RowVector3d from = cup.shape.vertices.row(v), to = design.shape.vertices.row(v);
    CHECK(to.z() == Approx(from.z()).margin(1e-9));
    if (from.z() == frustum.height) CHECK((to - from).norm() < 1e-9);
    if (from.z() == 0 && from.head<2>().norm() > frustum.outer_bottom - 1e-9)
      CHECK(to.head<2>().norm() == Approx(0.9 * from.head<2>().norm()));
  }
}

TEST_CASE("Only controllers taper, and only the shape", "[taper]") {
  const StructuredShape rest = structures::table();
  const ControllerModel model(rest, {}, Following::smooth);
  CHECK_THROWS_AS(model.edited(model.at_rest(), {{HandleKind::part, 0, 0}, Taper{0.9, {0, 0, 1}, {}}}),
                  UsageError);
  CHECK_THROWS_AS(model.edited(model.at_rest(), taper(0, {0, 0, 1})), UsageError);
  CHECK_THROWS_AS(model.edited(model.at_rest(), taper(0.9, {0, 0, 0})), UsageError);
  CHECK_THROWS_AS(model.edited(model.at_rest(), taper(0.9, {0, 0, 1}, Eigen::Vector3d(1, 0, 1))), UsageError);
}

TEST_CASE("A taper that a symmetry does not have is refused", "[taper]") {
  StructuredShape rest = structures::table();
  Relation quarter;
  quarter.type = RelationType::self_symmetry;
  quarter.parts = {structures::part_named(rest, "top")};
  quarter.symmetry.kind = SymmetryKind::rotation;
  quarter.symmetry.axis = Eigen::Vector3d::UnitZ();
  quarter.symmetry.order = 4;
  rest.structure.relations.push_back(quarter);
  const ControllerModel model(rest, {}, Following::smooth);
  const DeformationResult result =
      model.edited(model.at_rest(), taper(0.9, {0, 0, 1}, Eigen::Vector3d::UnitX()));
  REQUIRE(result.refusal);
  CHECK(result.refusal->cause == RefusalCause::symmetry_of_shape);
}
