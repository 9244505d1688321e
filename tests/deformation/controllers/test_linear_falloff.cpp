#include <cmath>

#include "stackabilization/deformation/controller_model.h"
#include "stackabilization/deformation/relation_residual.h"
#include "support/catch.h"
#include "support/structures.h"

using namespace stackabilization;
using structures::cylinder;

namespace {

/// What the edit does to the shape, which must not refuse it.
std::vector<Primitive> made(const StructuredShape& rest, const Handle& handle, const Operation& operation,
                            const DeformationConstraints& constraints = {}) {
  const ControllerModel model(rest);
  const DeformationResult outcome =
      model.edited(model.at_rest(), {handle, operation, Falloff::linear}, constraints);
  if (outcome.refusal) FAIL(describe(*outcome.refusal, rest.structure));
  for (const double residual : relation_residuals(rest.structure, outcome.design.primitives))
    CHECK(residual < 1e-12);
  return outcome.design.primitives;
}

Handle section(int index, int part = 0) {
  return {HandleKind::section, part, index};
}

/// A leg from the origin up, four long, its sections at unequal distances.
GeneralizedCylinder uneven_leg() {
  GeneralizedCylinder leg = structures::straight_cylinder({0, 0, 0}, {0, 0, 4}, 0.5, 6);
  leg.centres.col(2) << 0, 0.25, 1, 1.5, 3.5, 4;
  return leg;
}

Relation mirrored(std::vector<int> parts, const Eigen::Vector3d& axis) {
  Relation relation;
  relation.type = parts.size() == 1 ? RelationType::self_symmetry : RelationType::symmetry;
  relation.parts = std::move(parts);
  relation.symmetry.axis = axis;
  return relation;
}

/// Two uneven legs that the plane x = 0 mirrors, the second with its sections in the other order.
StructuredShape pair_of_legs() {
  GeneralizedCylinder left = uneven_leg(), right = uneven_leg();
  left.centres.col(0).array() -= 3;
  right.centres.col(0).array() += 3;
  right.centres = right.centres.colwise().reverse().eval();
  const StructuredShape a = structures::tube_alone(left, 8), b = structures::tube_alone(right, 8);
  StructuredShape pair = a;
  Shape second = b.shape;
  second.part_names = {"second"};
  pair.shape = concatenate(a.shape, second);
  pair.structure.parts.push_back(b.structure.parts.front());
  pair.structure.parts.back().name = "second";
  pair.structure.relations = {mirrored({0, 1}, Eigen::Vector3d::UnitX())};
  pair.structure.diagonal *= 2;
  return pair;
}

}  // namespace

TEST_CASE("a straight leg whose foot is moved leans and stays straight") {
  const StructuredShape rest = structures::tube_alone(uneven_leg(), 12);
  const Eigen::RowVector3d by(0.6, -0.2, 0.1);
  const GeneralizedCylinder before = cylinder({rest.structure.parts.front().primitive});
  const GeneralizedCylinder after = cylinder(made(rest, section(0), Move{by.transpose()}));
  for (Eigen::Index i = 0; i < 6; ++i) {
    const double share = (4 - before.centres(i, 2)) / 4;
    CHECK((after.centres.row(i) - before.centres.row(i) - share * by).norm() < 1e-14);
  }
  CHECK(after.radii == before.radii);
}

TEST_CASE("beyond the handle a linear change goes on") {
  const GeneralizedCylinder leg = uneven_leg();
  const StructuredShape rest = structures::tube_alone(leg, 12);
  const GeneralizedCylinder after = cylinder(made(rest, section(2), Scale{1.4, {}}));
  for (Eigen::Index i = 0; i < 6; ++i)
    CHECK(after.radii(i) == Approx(0.5 + 0.2 * (4 - leg.centres(i, 2)) / 3).epsilon(1e-14));
  const GeneralizedCylinder upper = cylinder(made(rest, section(4), Scale{1.4, {}}));
  for (Eigen::Index i = 0; i < 6; ++i)
    CHECK(upper.radii(i) == Approx(0.5 + 0.2 * leg.centres(i, 2) / 3.5).epsilon(1e-14));
}

TEST_CASE("from the middle a linear change goes to nothing at the last section") {
  const StructuredShape rest =
      structures::tube_alone(structures::straight_cylinder({0, 0, 0}, {0, 0, 4}, 0.5, 5), 12);
  const GeneralizedCylinder after = cylinder(made(rest, section(2), Scale{1.2, {}}));
  for (Eigen::Index i = 0; i < 5; ++i)
    CHECK(after.radii(i) == Approx(0.5 + 0.1 * (4 - static_cast<double>(i)) / 2).epsilon(1e-14));
}

TEST_CASE("where sections have slid, a linear change is linear in where they are now") {
  const StructuredShape rest = structures::tube_alone(uneven_leg(), 12);
  const ControllerModel model(rest);
  Design now = model.at_rest();
  auto& leg = std::get<GeneralizedCylinder>(now.primitives[0]);
  leg.centres.col(2) << 0, 0.7, 1.4, 2.5, 3.6, 4;
  const GeneralizedCylinder slid = leg;
  const Eigen::RowVector3d by(0.5, 0, 0);
  const DeformationResult moved = model.edited(now, {section(0), Move{by.transpose()}, Falloff::linear}, {});
  const DeformationResult scaled = model.edited(now, {section(5), Scale{2, {}}, Falloff::linear}, {});
  REQUIRE_FALSE(moved.refusal);
  REQUIRE_FALSE(scaled.refusal);
  for (Eigen::Index i = 0; i < 6; ++i) {
    const double height = slid.centres(i, 2) / 4;
    CHECK(
        (cylinder(moved.design.primitives).centres.row(i) - slid.centres.row(i) - (1 - height) * by).norm() <
        1e-14);
    CHECK(cylinder(scaled.design.primitives).radii(i) == Approx(0.5 + 0.5 * height).epsilon(1e-14));
  }
}

TEST_CASE("arc length counts, not distance") {
  const GeneralizedCylinder arc = structures::arc_cylinder(3, 0.4, 0, 2.5, 9);
  const StructuredShape rest = structures::tube_alone(arc, 10);
  const Eigen::RowVector3d by(0.1, 0.2, -0.3);
  const GeneralizedCylinder after = cylinder(made(rest, section(8), Move{by.transpose()}));
  for (Eigen::Index i = 0; i < 9; ++i)
    CHECK((after.centres.row(i) - arc.centres.row(i) - static_cast<double>(i) / 8 * by).norm() < 1e-14);
}

TEST_CASE("the mesh of a leaning leg is straight as well, and a widened one is a cone") {
  const StructuredShape rest =
      structures::tube_alone(structures::straight_cylinder({0, 0, 0}, {0, 0, 4}, 0.5, 9), 16);
  const ControllerModel model(rest);
  const Shape cone = model.shape_of(made(rest, section(0), Scale{0.5, {}}));
  for (Eigen::Index v = 0; v < 9 * 16; ++v)
    CHECK(cone.vertices.row(v).head<2>().norm() == Approx(0.25 + cone.vertices(v, 2) / 16).epsilon(1e-12));
  const Shape leaning = model.shape_of(made(rest, section(0), Move{{1, 0, 0}}));
  const Eigen::RowVector3d axis = Eigen::RowVector3d(-1, 0, 4).normalized(), foot(1, 0, 0);
  for (Eigen::Index v = 0; v < 9 * 16; ++v)
    CHECK((leaning.vertices.row(v) - foot).cross(axis).norm() == Approx(0.5).epsilon(1e-12));
}

TEST_CASE("both legs of a pair lean, whichever is taken hold of and however its sections are counted") {
  const StructuredShape rest = pair_of_legs();
  const Eigen::RowVector3d by(0.5, 0.25, 0), image(-0.5, 0.25, 0);
  const std::vector<Primitive> first = made(rest, section(0, 0), Move{by.transpose()});
  const std::vector<Primitive> second = made(rest, section(5, 1), Move{image.transpose()});
  for (const int part : {0, 1}) {
    CHECK((cylinder(first, part).centres - cylinder(second, part).centres).norm() < 1e-13);
    const auto& before =
        std::get<GeneralizedCylinder>(rest.structure.parts[static_cast<std::size_t>(part)].primitive);
    for (Eigen::Index i = 0; i < 6; ++i) {
      const Eigen::RowVector3d moved = cylinder(first, part).centres.row(i) - before.centres.row(i);
      CHECK((moved - (4 - before.centres(i, 2)) / 4 * (part == 0 ? by : image)).norm() < 1e-14);
    }
  }
}

TEST_CASE("a bar mirrored about its middle widens and moves evenly, and is stretched") {
  const GeneralizedCylinder bar = structures::straight_cylinder({-2, 0, 1}, {2, 0, 1}, 0.5, 5);
  StructuredShape rest = structures::tube_alone(bar, 12);
  rest.structure.relations = {mirrored({0}, Eigen::Vector3d::UnitX())};
  for (const int handle : {0, 3}) {
    const GeneralizedCylinder wide = cylinder(made(rest, section(handle), Scale{1.2, {}}));
    CHECK((wide.radii.array() - 0.6).abs().maxCoeff() < 1e-14);
    const GeneralizedCylinder lifted = cylinder(made(rest, section(handle), Move{{0, 0, 0.5}}));
    CHECK((lifted.centres - (bar.centres.rowwise() + Eigen::RowVector3d(0, 0, 0.5))).norm() < 1e-14);
    const GeneralizedCylinder longer =
        cylinder(made(rest, section(handle), Move{{bar.centres(handle, 0) / 4, 0, 0}}));
    CHECK((longer.centres.col(0) - 1.25 * bar.centres.col(0)).norm() < 1e-14);
  }
  const ControllerModel model(rest);
  const DeformationResult outcome =
      model.edited(model.at_rest(), {section(2), Move{{0.1, 0, 0}}, Falloff::linear});
  REQUIRE(outcome.refusal);
  CHECK(outcome.refusal->relation == 0);
}

TEST_CASE("what is joined at the far end stays, and the handle goes where it should") {
  const StructuredShape rest = structures::mug();
  const GeneralizedCylinder body = cylinder({rest.structure.parts.front().primitive});
  const std::vector<Primitive> now = made(rest, section(0), Scale{0.8, {}});
  CHECK(cylinder(now).radii(0) == Approx(0.8 * body.radii(0)).epsilon(1e-13));
  CHECK(cylinder(now).radii(body.radii.size() - 1) ==
        Approx(body.radii(body.radii.size() - 1)).epsilon(0.02));
}

TEST_CASE("around a closed curve linear is as gaussian") {
  const StructuredShape rest = structures::tube_alone(structures::ring_cylinder(2, 0.3, 12), 10);
  const ControllerModel model(rest);
  for (const Operation& operation : std::vector<Operation>{Move{{0, 0, 0.3}}, Scale{1.3, {}}}) {
    const Shape linear = model.deformed({{section(3), operation, Falloff::linear}}).design.shape;
    CHECK(linear.vertices ==
          model.deformed({{section(3), operation, Falloff::gaussian}}).design.shape.vertices);
  }
}

TEST_CASE("linear falloff keeps the extent where that is asked for") {
  const StructuredShape rest = structures::tube_alone(uneven_leg(), 12);
  DeformationConstraints constraints;
  constraints.keep_extent = Direction(0, 0, 1);
  const ControllerModel model(rest);
  const Shape after = model.shape_of(made(rest, section(0), Move{{0.6, 0, 0}}, constraints));
  CHECK(range_along(after, Eigen::Vector3d::UnitZ()).length() == Approx(4).epsilon(1e-9));
}
