#include "deformation/controllers/row_points.h"
#include "stackabilization/deformation/controller_model.h"
#include "stackabilization/deformation/tolerances.h"
#include "support/catch.h"
#include "support/structures.h"

using namespace stackabilization;

namespace {

Eigen::Vector3d size_of(const Primitive& primitive) {
  const Points points = control_points(primitive);
  return (points.colwise().maxCoeff() - points.colwise().minCoeff()).transpose();
}

Eigen::Vector3d centre_of(const Primitive& primitive) {
  return control_points(primitive).colwise().mean().transpose();
}

Design edited(const ControllerModel& model, const std::string& part, const Operation& operation) {
  const Handle handle{HandleKind::part, structures::part_named(model.rest(), part), 0};
  const DeformationResult result = model.deformed({{handle, operation}});
  REQUIRE_FALSE(result.refusal);
  return result.design;
}

const Scale shorter{0.9, Eigen::Vector3d::UnitX()}, narrower{0.9, Eigen::Vector3d::UnitY()};

}  // namespace

TEST_CASE("the slats of a row keep one form and even steps, whichever is edited") {
  const ControllerModel smooth(structures::slats_on_rails(), {}, Following::smooth);
  for (const char* slat : {"slat_1", "slat_2", "slat_3", "slat_5"}) {
    const std::vector<Primitive> now = edited(smooth, slat, shorter).primitives;
    for (std::size_t k = 0; k < 5; ++k)
      CHECK((size_of(now[k]) - Eigen::Vector3d(18, 1.2, 0.5)).norm() <= 1e-6);
  }
  const std::vector<Primitive> now = edited(smooth, "slat_5", Move{Eigen::Vector3d(0, -0.4, 0)}).primitives;
  for (std::size_t k = 0; k < 5; ++k)
    CHECK((centre_of(now[k]) - Eigen::Vector3d(0, 1.8 * (static_cast<double>(k) - 2), 0.25)).norm() <= 1e-6);
}

TEST_CASE("without smooth following slats are their own") {
  const ControllerModel free(structures::slats_on_rails());
  const std::vector<Primitive> now = edited(free, "slat_1", narrower).primitives;
  CHECK(size_of(now[0]).y() == Approx(1.08));
  CHECK(size_of(now[2]).y() == Approx(1.2));
}

TEST_CASE("a row that is no image of itself may get longer by even steps") {
  const ControllerModel smooth(structures::slats_on_rails(true), {}, Following::smooth);
  const std::vector<Primitive> now = edited(smooth, "slat_1", shorter).primitives;
  CHECK(size_of(now[0]).x() == Approx(18));
  for (std::size_t k = 1; k < 4; ++k)
    CHECK((control_points(now[k - 1]) - 2 * control_points(now[k]) + control_points(now[k + 1]) -
           (control_points(smooth.rest().structure.parts[k - 1].primitive) -
            2 * control_points(smooth.rest().structure.parts[k].primitive) +
            control_points(smooth.rest().structure.parts[k + 1].primitive)))
              .norm() <= 1e-6);
}

TEST_CASE("what is fixed of a row holds the rest, and a part that cannot stay in its row is refused") {
  const ControllerModel smooth(structures::slats_on_rails(), {}, Following::smooth);
  DeformationConstraints constraints;
  constraints.fixed_parts = {structures::part_named(smooth.rest(), "slat_3")};
  const Handle handle{HandleKind::part, structures::part_named(smooth.rest(), "slat_2"), 0};
  const DeformationResult result = smooth.deformed({{handle, narrower}}, constraints);
  REQUIRE(result.refusal);
  CHECK(result.refusal->cause == RefusalCause::uneven_row);
  CHECK(result.refusal->amount > tolerance::relation);
}

TEST_CASE("a row that is a little uneven at rest stays as it is when the whole changes its size") {
  StructuredShape rest = structures::slats_on_rails(true);
  const double off = 0.04;
  std::get<Cuboid>(rest.structure.parts[1].primitive).corners.col(1).array() += off;
  for (Relation& relation : rest.structure.relations)
    if (relation.is_joint() && relation.parts[0] == 1) relation.points.col(1).array() += off;
  const ControllerModel smooth(rest, {}, Following::smooth);
  REQUIRE_FALSE(detail::Rig(rest.structure, Following::smooth).row_points.empty());
  const DeformationResult result = smooth.deformed({{{HandleKind::shape, 0, 0}, Scale{1.3, {}}}});
  REQUIRE_FALSE(result.refusal);
  for (std::size_t k = 0; k < result.design.primitives.size(); ++k) {
    const Points before = control_points(rest.structure.parts[k].primitive),
                 now = control_points(result.design.primitives[k]);
    const Points sides = now.rowwise() - now.row(0), sides_before = before.rowwise() - before.row(0);
    CHECK((sides - 1.3 * sides_before).norm() <= 1e-9);
  }
}

TEST_CASE("a rung that moves between leaning legs takes its row along, and the legs stay") {
  const ControllerModel smooth(structures::ladder(), {}, Following::smooth);
  const std::vector<Part>& rest = smooth.rest().structure.parts;
  const std::vector<Primitive> now = edited(smooth, "rung_1", Move{Eigen::Vector3d(0, 0, 0.6)}).primitives;
  for (const std::size_t leg : {0u, 1u})
    CHECK(control_points(now[leg]) == control_points(rest[leg].primitive));
  double last = 0;
  for (std::size_t k = 2; k < 9; ++k) {
    const GeneralizedCylinder rung = std::get<GeneralizedCylinder>(now[k]);
    const Eigen::RowVector3d end = rung.centres.row(rung.centres.rows() - 1);
    CHECK(std::abs(end.x()) == Approx(5 - end.z() / 8).margin(0.05));
    if (k > 3)
      CHECK(end.z() - last == Approx(last - std::get<GeneralizedCylinder>(now[k - 2]).centres(0, 2)));
    last = end.z();
  }
  CHECK(std::get<GeneralizedCylinder>(now[2]).centres(0, 2) == Approx(2.6));
}

TEST_CASE("images of a row have no row points of their own") {
  const detail::Rig whole(structures::slats_on_rails().structure, Following::smooth),
      skewed(structures::slats_on_rails(true).structure, Following::smooth);
  CHECK(whole.row_points.size() == 2 * 4);
  CHECK(skewed.row_points.size() == 3 * 4);
  CHECK(detail::Rig(structures::slats_on_rails().structure).row_points.empty());
  CHECK(detail::Rig(structures::table().structure, Following::smooth).row_points.empty());
}
