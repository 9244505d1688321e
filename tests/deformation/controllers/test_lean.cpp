#include <cmath>
#include <numbers>

#include "stackabilization/core/errors.h"
#include "stackabilization/deformation/controller_model.h"
#include "stackabilization/deformation/factory.h"
#include "stackabilization/deformation/relation_residual.h"
#include "support/catch.h"
#include "support/structures.h"

using namespace stackabilization;

namespace {

const Direction up(Eigen::Vector3d::UnitZ());

/// A hoop of tube below the origin, in the plane y = 0: the half circle of radius 4 that opens upwards.
StructuredShape hoop() {
  return structures::tube_alone(structures::arc_cylinder(4, 0.5, std::numbers::pi, 2 * std::numbers::pi, 25),
                                16);
}

Edit lean(const Eigen::Vector3d& by, const Eigen::Vector3d& axis) {
  return {{HandleKind::part, 0, 0}, Lean{by, axis}};
}

const GeneralizedCylinder& tube(const Design& design) {
  return std::get<GeneralizedCylinder>(design.primitives.front());
}

}  // namespace

TEST_CASE("a hoop that leans moves by the height of its places below its ends, and its tube stays round") {
  const StructuredShape rest = hoop();
  const ControllerModel model(rest, {}, Following::smooth);
  const GeneralizedCylinder before = tube(model.at_rest());
  const DeformationResult result = model.edited(model.at_rest(), lean({0, 3, 0}, {0, 0, -2}));
  REQUIRE_FALSE(result.refusal);
  const GeneralizedCylinder& after = tube(result.design);
  CHECK((after.radii - before.radii).norm() < 1e-12);
  const double top = before.centres.col(2).maxCoeff(), bottom = before.centres.col(2).minCoeff();
  for (Eigen::Index k = 0; k < before.centres.rows(); ++k) {
    const double share = (top - before.centres(k, 2)) / (top - bottom);
    CHECK((after.centres.row(k) - before.centres.row(k) - Eigen::RowVector3d(0, 3 * share, 0)).norm() <
          1e-12);
  }
  // The other way round, the ends move.
  const DeformationResult ends = model.edited(model.at_rest(), lean({0, 3, 0}, {0, 0, 1}));
  REQUIRE_FALSE(ends.refusal);
  CHECK(tube(ends.design).centres(0, 1) == Approx(3));
}

TEST_CASE("a hoop that leans turns its sections with it: sides that lie in one plane do afterwards") {
  const StructuredShape rest = hoop();
  const ControllerModel model(rest, {}, Following::smooth);
  const DeformationResult result = model.edited(model.at_rest(), lean({0, 3, 0}, {0, 0, -2}));
  REQUIRE_FALSE(result.refusal);
  const Points centres = tube(model.at_rest()).centres;
  const double height = centres.col(2).maxCoeff() - centres.col(2).minCoeff();
  const Eigen::RowVector3d normal = Eigen::RowVector3d(0, height, 3).normalized();
  const double side = rest.shape.vertices.col(1).maxCoeff(), top = centres.col(2).maxCoeff();
  int count = 0;
  for (Eigen::Index v = 0; v < rest.shape.vertex_count(); ++v) {
    if (std::abs(std::abs(rest.shape.vertices(v, 1)) - side) > 1e-9) continue;
    ++count;
    const Eigen::RowVector3d place = result.design.shape.vertices.row(v) - Eigen::RowVector3d(0, 0, top);
    CHECK(place.dot(normal) == Approx(rest.shape.vertices(v, 1)).epsilon(1e-9));
  }
  CHECK(count == 2 * centres.rows());
}

TEST_CASE("a hoop that leans stands where it stood, however far it leans") {
  const StructuredShape rest = hoop();
  const ControllerModel model(rest, {}, Following::smooth);
  DeformationConstraints constraints;
  constraints.keep_extent = up;
  constraints.extent_ends = ExtentEnds::fixed;
  const Range before = range_along(rest.shape, up.unit());
  for (const double by : {0.1, 1.0, 2.0}) {
    const DeformationResult result = model.edited(model.at_rest(), lean({0, by, 0}, {0, 0, -1}), constraints);
    REQUIRE_FALSE(result.refusal);
    const Range after = range_along(result.design.shape, up.unit());
    CHECK(std::abs(after.low - before.low) < 1e-8);
    CHECK(std::abs(after.high - before.high) < 1e-8);
    const GeneralizedCylinder now = tube(result.design), then = tube(model.at_rest());
    // Heights give way, what lies across them does not, nor do radii.
    CHECK((now.radii - then.radii).norm() < 1e-9);
    Eigen::Index lowest = 0;
    then.centres.col(2).minCoeff(&lowest);
    CHECK(now.centres(lowest, 1) == Approx(by));
  }
}

TEST_CASE("a leaning of a cuboid shears it") {
  const StructuredShape rest = structures::box_alone({2, 2, 6});
  const ControllerModel model(rest, {}, Following::smooth);
  const DeformationResult result = model.edited(model.at_rest(), lean({1, 0, 0}, {0, 0, 1}));
  REQUIRE_FALSE(result.refusal);
  const double low = rest.shape.vertices.col(2).minCoeff();
  for (Eigen::Index v = 0; v < rest.shape.vertex_count(); ++v) {
    const Eigen::RowVector3d moved = result.design.shape.vertices.row(v) - rest.shape.vertices.row(v);
    CHECK((moved - Eigen::RowVector3d((rest.shape.vertices(v, 2) - low) / 6, 0, 0)).norm() < 1e-9);
  }
}

TEST_CASE("a leaning that a symmetry does not have is refused") {
  StructuredShape rest = hoop();
  Relation mirror;
  mirror.type = RelationType::self_symmetry;
  mirror.parts = {0};
  mirror.symmetry.axis = Eigen::Vector3d::UnitX();
  rest.structure.relations = {mirror};
  const ControllerModel model(rest, {}, Following::smooth);
  CHECK_FALSE(model.edited(model.at_rest(), lean({0, 1, 0}, {0, 0, -1})).refusal);
  const DeformationResult result = model.edited(model.at_rest(), lean({1, 0, 0}, {0, 0, -1}));
  REQUIRE(result.refusal);
  CHECK(result.refusal->cause == RefusalCause::symmetry);
}

TEST_CASE("only controllers lean, only parts, and only across the axis") {
  const StructuredShape rest = hoop();
  for (const DeformationKind kind : {DeformationKind::surface, DeformationKind::iwires}) {
    const auto model = deformation_model(rest, {.kind = kind});
    CHECK_THROWS_AS(model->edited(model->at_rest(), lean({0, 1, 0}, {0, 0, 1})), UsageError);
  }
  CHECK_THROWS_AS(validate(lean({0, 1, 1}, {0, 0, 1})), UsageError);
  CHECK_THROWS_AS(validate(lean({0, 1, 0}, {0, 0, 0})), UsageError);
  CHECK_THROWS_AS(validate(lean({0, NAN, 0}, {0, 0, 1})), UsageError);
  CHECK_THROWS_AS(validate(lean({0, 1001, 0}, {0, 0, 1}), 1), UsageError);
  CHECK_NOTHROW(validate(lean({0, 1000, 0}, {0, 0, 1}), 1));
  CHECK_NOTHROW(validate(lean({0, 0, 0}, {0, 0, 1})));
  for (const HandleKind kind : {HandleKind::shape, HandleKind::section, HandleKind::face})
    CHECK_THROWS_AS(validate(Edit{{kind, 0, 0}, Lean{{0, 1, 0}, {0, 0, 1}}}), UsageError);
}
