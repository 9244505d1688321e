#include <Eigen/Geometry>
#include <Eigen/QR>
#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

#include "deformation/controllers/straightness.h"
#include "deformation/model/straight_curve.h"
#include "stackabilization/deformation/controller_model.h"
#include "stackabilization/deformation/relation_residual.h"
#include "support/catch.h"
#include "support/structures.h"

using namespace stackabilization;

namespace {

GeneralizedCylinder cone() {
  GeneralizedCylinder cone = structures::straight_cylinder({1, 2, 3}, {2, 4, 9}, 1, 12);
  for (Eigen::Index i = 0; i < cone.radii.size(); ++i) cone.radii(i) = 1 + 0.1 * static_cast<double>(i);
  return cone;
}

Points moved_centres(const GeneralizedCylinder& cylinder, const Eigen::VectorXd& values) {
  const Eigen::Index n = cylinder.centres.rows();
  const Eigen::VectorXd moves = values.head(3 * n);
  return cylinder.centres + Eigen::Map<const Points>(moves.data(), n, 3);
}

/// Largest distance of the radii, over the places along the chord, from the line through first and last.
double profile_bend(const GeneralizedCylinder& cylinder) {
  const Eigen::VectorXd places = detail::places_along_chord(cylinder);
  const Eigen::Index last = places.size() - 1;
  const double slope = (cylinder.radii(last) - cylinder.radii(0)) / places(last);
  return (cylinder.radii.array() - cylinder.radii(0) - slope * places.array()).abs().maxCoeff();
}

/// Largest distance of the centres from the line through the first and the last.
double bend(const Points& centres) {
  const Eigen::RowVector3d chord = (centres.row(centres.rows() - 1) - centres.row(0)).normalized();
  double farthest = 0;
  for (Eigen::Index i = 0; i < centres.rows(); ++i) {
    const Eigen::RowVector3d offset = centres.row(i) - centres.row(0);
    farthest = std::max(farthest, (offset - offset.dot(chord) * chord).norm());
  }
  return farthest;
}

}  // namespace

TEST_CASE("corrections of straight cylinders slide, lean and stretch, but do not bend") {
  const GeneralizedCylinder cylinder = cone();
  const Eigen::MatrixXd slides = detail::slide_functions(cylinder);
  const Eigen::MatrixXd columns = detail::StraightCorrections(cylinder, slides, 1, {}).columns(cylinder);
  const Eigen::Index n = cylinder.centres.rows();
  const double step = 1e-4;
  double worst = 0, slid = 0;
  const Eigen::RowVector3d along = (cylinder.centres.row(n - 1) - cylinder.centres.row(0)).normalized();
  for (Eigen::Index c = 0; c < columns.cols(); ++c) {
    worst = std::max(worst, bend(moved_centres(cylinder, step * columns.col(c))));
    const Eigen::VectorXd places = moved_centres(cylinder, columns.col(c)) * along.transpose();
    for (Eigen::Index i = 2; i < n; ++i)
      slid = std::max(slid, std::abs(places(i) - 2 * places(i - 1) + places(i - 2)));
  }
  CHECK(worst < 1e-7);  // of second order
  CHECK(slid > 1e-3);
  // Translations, leanings and stretches of the whole are all left: any affine motion of a line.
  Eigen::MatrixXd affine = Eigen::MatrixXd::Zero(4 * n, 6);
  for (Eigen::Index i = 0; i < n; ++i)
    for (int k = 0; k < 3; ++k) {
      affine(3 * i + k, k) = 1;
      affine(3 * i + k, 3 + k) = static_cast<double>(i);
    }
  const Eigen::MatrixXd missing = affine - columns * columns.completeOrthogonalDecomposition().solve(affine);
  CHECK(missing.cwiseAbs().maxCoeff() < 1e-12 * n);
}

TEST_CASE("a settled step leaves a cone a straight cone, however long it is") {
  const GeneralizedCylinder cylinder = cone();
  const Eigen::MatrixXd slides = detail::slide_functions(cylinder);
  const detail::StraightCorrections corrections(cylinder, slides, 1, {});
  const Eigen::MatrixXd columns = corrections.columns(cylinder);
  const Eigen::Index n = cylinder.centres.rows();
  Eigen::VectorXd amounts(columns.cols());
  for (Eigen::Index c = 0; c < amounts.size(); ++c)
    amounts(c) = 0.4 * std::sin(1 + 3.0 * static_cast<double>(c));
  const Eigen::VectorXd step = columns * amounts;
  GeneralizedCylinder now = cylinder;
  now.centres = moved_centres(cylinder, step);
  now.radii += step.tail(n);
  REQUIRE(bend(now.centres) > 1e-3);
  REQUIRE(profile_bend(now) > 1e-3);
  const GeneralizedCylinder settled = corrections.retract(now);
  CHECK(bend(settled.centres) < 1e-13);
  CHECK(profile_bend(settled) < 1e-13);
  CHECK((settled.centres.row(0) - now.centres.row(0)).norm() < 1e-14);
  CHECK((settled.centres.row(n - 1) - now.centres.row(n - 1)).norm() < 1e-14);
  // Nothing is left to settle.
  const GeneralizedCylinder again = corrections.retract(settled);
  CHECK((again.centres - settled.centres).cwiseAbs().maxCoeff() < 1e-13);
  CHECK((again.radii - settled.radii).cwiseAbs().maxCoeff() < 1e-13);
}

TEST_CASE("what an edit prescribes of a straight cylinder is not settled away") {
  const GeneralizedCylinder cylinder = cone();
  const Eigen::MatrixXd slides = detail::slide_functions(cylinder);
  const detail::StraightCorrections corrections(cylinder, slides, 1, {4, 7});
  GeneralizedCylinder now = cylinder;
  now.centres.row(4) += Eigen::RowVector3d(0.3, -0.2, 0.1);
  now.centres.row(9) += Eigen::RowVector3d(-0.1, 0.4, 0.2);
  const GeneralizedCylinder settled = corrections.retract(now);
  CHECK(settled.centres.row(4) == now.centres.row(4));
  CHECK(settled.radii(7) == Approx(cylinder.radii(7)).epsilon(1e-14));
  CHECK(bend(settled.centres) < 1e-13);
}

TEST_CASE("what is slightly bent is carried as it is") {
  GeneralizedCylinder bow = cone();
  const Eigen::RowVector3d chord = bow.centres.row(11) - bow.centres.row(0);
  const Eigen::Vector3d across = Eigen::Vector3d(chord.transpose()).unitOrthogonal();
  for (Eigen::Index i = 0; i < 12; ++i)
    bow.centres.row(i) +=
        0.01 * std::sin(std::numbers::pi * static_cast<double>(i) / 11) * across.transpose();
  REQUIRE(detail::is_straight(bow));
  const Eigen::MatrixXd slides = detail::slide_functions(bow);
  const detail::StraightCorrections corrections(bow, slides, 1, {});
  const Eigen::Matrix3d turn = Eigen::AngleAxisd(0.7, Eigen::Vector3d(1, 2, -1).normalized()).matrix();
  GeneralizedCylinder now = bow;
  now.centres = bow.centres * turn.transpose();
  CHECK(bend(corrections.retract(now).centres) == Approx(bend(bow.centres)).epsilon(1e-12));
  now.centres = bow.centres + 0.3 * Eigen::VectorXd::LinSpaced(12, 0, 1) * across.transpose();
  CHECK(bend(corrections.retract(now).centres) == Approx(bend(bow.centres)).epsilon(1e-12));
}

TEST_CASE("the least slide to a place is linear on either side, and stiff at the ends") {
  const GeneralizedCylinder rod = structures::straight_cylinder({0, 0, 0}, {0, 0, 4}, 0.2, 41);
  const Eigen::MatrixXd slides = detail::slide_functions(rod);
  CHECK(slides.row(0).isZero(0));
  CHECK(slides.row(40).isZero(0));
  // Of all slides S y with (S y)_15 = 1, the one of least |y|.
  const Eigen::VectorXd slide = slides * slides.row(15).transpose() / slides.row(15).squaredNorm();
  const Eigen::VectorXd strain = slide.tail(40) - slide.head(40);
  const double below = strain(10), above = strain(25);
  CHECK(below > 0);
  CHECK(above < 0);
  for (Eigen::Index i = 3; i < 15; ++i) CHECK(strain(i) == Approx(below).epsilon(1e-9));
  for (Eigen::Index i = 15; i < 37; ++i) CHECK(strain(i) == Approx(above).epsilon(1e-9));
  for (Eigen::Index i = 0; i < 2; ++i) CHECK(std::abs(strain(i)) < 0.06 * below);
  for (Eigen::Index i = 38; i < 40; ++i) CHECK(std::abs(strain(i)) < 0.06 * -above);
}

TEST_CASE("a wall stays straight through a list of edits") {
  const ControllerModel model(structures::mug());
  DeformationConstraints constraints;
  constraints.keep_extent = Direction(0, 0, 1);
  constraints.extent_ends = ExtentEnds::fixed;
  const Range before = range_along(model.rest().shape, Eigen::Vector3d::UnitZ());
  const Handle foot{HandleKind::section, 0, 0}, rim{HandleKind::section, 0, 10};
  const Handle grip{HandleKind::part, 1, 0};
  const auto low_end = [](double by) { return Edit{{HandleKind::section, 1, 1}, Move{{0, 0, by}}}; };
  const std::vector<Edit> edits = {{foot, Scale{0.85, {}}, Falloff::linear},
                                   {grip, Move{{0, 0, 0.3}}},
                                   low_end(0.4),
                                   {rim, Scale{1.1, {}}, Falloff::linear},
                                   low_end(0.3),
                                   {foot, Move{{0.2, 0, 0}}, Falloff::linear},
                                   {grip, Move{{0.1, 0, -0.2}}},
                                   {rim, Move{{-0.2, 0, 0}}, Falloff::linear},
                                   low_end(0.3),
                                   {foot, Scale{0.95, {}}, Falloff::linear}};
  Design now = model.at_rest();
  for (const Edit& edit : edits) {
    const DeformationResult outcome = model.edited(now, edit, constraints);
    if (outcome.refusal) FAIL(describe(*outcome.refusal, model.rest().structure));
    now = outcome.design;
    const auto& body = std::get<GeneralizedCylinder>(now.primitives[0]);
    CHECK(bend(body.centres) < 1e-12 * 10);
    CHECK(profile_bend(body) < 1e-12 * 10);
  }
  const auto& body = std::get<GeneralizedCylinder>(now.primitives[0]);
  const Eigen::VectorXd places = detail::places_along_chord(body);
  CHECK(std::abs(places(4) - 0.4 * places(10)) > 0.1);  // the sections did slide
  for (const double residual : model.relation_residuals(now)) CHECK(residual < 1e-6);
  const Range after = range_along(now.shape, Eigen::Vector3d::UnitZ());
  CHECK(after.low == Approx(before.low).margin(1e-9 * before.length()));
  CHECK(after.high == Approx(before.high).margin(1e-9 * before.length()));
}

TEST_CASE("walls are straight as cylinders and cones are") {
  GeneralizedCylinder wall = cone();
  CHECK(detail::has_straight_wall(wall));
  wall.radii(5) += 0.1;
  CHECK(detail::has_straight_wall(wall));
  wall.radii(5) += 0.2;
  CHECK_FALSE(detail::has_straight_wall(wall));
  GeneralizedCylinder bow = structures::arc_cylinder(3, 0.4, 0, 2, 9);
  CHECK_FALSE(detail::has_straight_wall(bow));
  bow = cone();
  bow.centres.row(5) += Eigen::RowVector3d(0.3, 0, 0);
  CHECK_FALSE(detail::has_straight_wall(bow));
}

TEST_CASE("an edit of a single section still bends") {
  const ControllerModel model(structures::mug());
  const DeformationResult result = model.deformed({{{HandleKind::section, 0, 5}, Move{{0.3, 0, 0}}}});
  REQUIRE_FALSE(result.refusal);
  CHECK(bend(std::get<GeneralizedCylinder>(result.design.primitives[0]).centres) > 0.1);
}

TEST_CASE("what an edit moves along a height with fixed ends, it moves against the rest") {
  const ControllerModel model(structures::mug());
  DeformationConstraints constraints;
  constraints.keep_extent = Direction(0, 0, 1);
  constraints.extent_ends = ExtentEnds::fixed;
  const Range before = range_along(model.rest().shape, Eigen::Vector3d::UnitZ());
  const DeformationResult lean =
      model.deformed({{{HandleKind::section, 0, 0}, Scale{0.7, {}}, Falloff::linear}}, constraints);
  REQUIRE_FALSE(lean.refusal);
  const DeformationResult result =
      model.deformed({{{HandleKind::section, 0, 0}, Scale{0.7, {}}, Falloff::linear},
                      {{HandleKind::section, 1, 1}, Move{{0, 0, 0.4}}}},
                     constraints);
  REQUIRE_FALSE(result.refusal);
  const Range after = range_along(result.design.shape, Eigen::Vector3d::UnitZ());
  CHECK(after.low == Approx(before.low).margin(1e-9 * before.length()));
  CHECK(after.high == Approx(before.high).margin(1e-9 * before.length()));
  const auto& body = std::get<GeneralizedCylinder>(result.design.primitives[0]);
  CHECK(detail::is_straight(body));

  // Without fixed ends the whole mug goes up.
  constraints.extent_ends = ExtentEnds::free;
  const DeformationResult carried =
      model.deformed({{{HandleKind::part, 1, 0}, Move{{0, 0, 0.4}}}}, constraints);
  REQUIRE_FALSE(carried.refusal);
  CHECK(range_along(carried.design.shape, Eigen::Vector3d::UnitZ()).low > before.low + 0.1);
}
