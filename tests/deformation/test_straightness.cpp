#include <Eigen/QR>
#include <cmath>

#include "deformation/structures.h"
#include "stackabilization/deformation/controller_model.h"
#include "stackabilization/deformation/correction_basis.h"
#include "stackabilization/deformation/straightness.h"
#include "support/catch.h"

using namespace stackabilization;

namespace {

GeneralizedCylinder cone() {
  GeneralizedCylinder cone = structures::straight_cylinder({1, 2, 3}, {2, 4, 9}, 1, 12);
  for (Eigen::Index i = 0; i < cone.radii.size(); ++i) cone.radii(i) = 1 + 0.1 * static_cast<double>(i);
  return cone;
}

Points moved(const GeneralizedCylinder& cylinder, const Eigen::VectorXd& values) {
  const Eigen::Index n = cylinder.centres.rows();
  return cylinder.centres + Eigen::Map<const Points>(values.data(), n, 3);
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
  const Eigen::MatrixXd basis = detail::correction_basis(cylinder);
  const Eigen::MatrixXd columns = detail::straight_columns(cylinder, basis, detail::SlidingRadii::kept);
  const double step = 1e-4;
  double worst = 0, bent = 0, slid = 0;
  const Eigen::Index n = cylinder.centres.rows();
  const Eigen::RowVector3d along = (cylinder.centres.row(n - 1) - cylinder.centres.row(0)).normalized();
  for (Eigen::Index c = 0; c < columns.cols(); ++c) {
    worst = std::max(worst, bend(moved(cylinder, step * columns.col(c).head(3 * n))));
    const Eigen::VectorXd places = moved(cylinder, columns.col(c).head(3 * n)) * along.transpose();
    for (Eigen::Index i = 2; i < n; ++i)
      slid = std::max(slid, std::abs(places(i) - 2 * places(i - 1) + places(i - 2)));
  }
  for (Eigen::Index c = 0; c < basis.cols(); ++c)
    bent = std::max(bent, bend(moved(cylinder, step * basis.col(c).head(3 * n))));
  CHECK(worst < 1e-7);  // of second order
  CHECK(bent > 1e-6);
  CHECK(slid > 1e-3);
  // Translations, leanings and stretches of the whole are all left: any affine motion of a line.
  Eigen::MatrixXd affine = Eigen::MatrixXd::Zero(4 * n, 6);
  for (Eigen::Index i = 0; i < n; ++i)
    for (int k = 0; k < 3; ++k) {
      affine(3 * i + k, k) = 1;
      affine(3 * i + k, 3 + k) = static_cast<double>(i);
    }
  const Eigen::MatrixXd missing = affine - columns * columns.completeOrthogonalDecomposition().solve(affine);
  CHECK(missing.cwiseAbs().maxCoeff() < 1e-6 * n);
}

TEST_CASE("sections that slide take the radii of the places they come to") {
  const GeneralizedCylinder cylinder = cone();
  const Eigen::Index n = cylinder.centres.rows();
  const Eigen::MatrixXd basis = detail::correction_basis(cylinder);
  const Eigen::MatrixXd kept = detail::straight_columns(cylinder, basis, detail::SlidingRadii::kept),
                        placed = detail::straight_columns(cylinder, basis, detail::SlidingRadii::of_place);
  REQUIRE(kept.cols() == placed.cols());
  const Eigen::RowVector3d chord = cylinder.centres.row(n - 1) - cylinder.centres.row(0);
  const double slope = 0.1 * static_cast<double>(n - 1) / chord.norm();
  CHECK((placed.topRows(3 * n) - kept.topRows(3 * n)).cwiseAbs().maxCoeff() == 0);
  Eigen::MatrixXd line(n, 2);
  for (Eigen::Index i = 0; i < n; ++i) line.row(i) << 1, static_cast<double>(i);
  for (Eigen::Index c = 0; c < kept.cols(); ++c) {
    const Eigen::VectorXd values = kept.col(c).head(3 * n);
    const Eigen::VectorXd slides =
        Eigen::Map<const Points>(values.data(), n, 3) * chord.normalized().transpose();
    const Eigen::VectorXd uneven = slides - line * line.colPivHouseholderQr().solve(slides);
    CHECK((placed.col(c).tail(n) - kept.col(c).tail(n) - slope * uneven).cwiseAbs().maxCoeff() < 1e-12);
  }
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
  const Range after = range_along(result.shape, Eigen::Vector3d::UnitZ());
  CHECK(after.low == Approx(before.low).margin(1e-9 * before.length()));
  CHECK(after.high == Approx(before.high).margin(1e-9 * before.length()));
  const auto& body = std::get<GeneralizedCylinder>(result.primitives[0]);
  CHECK(detail::is_straight(body));

  // Without fixed ends the whole mug goes up.
  constraints.extent_ends = ExtentEnds::free;
  const DeformationResult carried =
      model.deformed({{{HandleKind::part, 1, 0}, Move{{0, 0, 0.4}}}}, constraints);
  REQUIRE_FALSE(carried.refusal);
  CHECK(range_along(carried.shape, Eigen::Vector3d::UnitZ()).low > before.low + 0.1);
}
