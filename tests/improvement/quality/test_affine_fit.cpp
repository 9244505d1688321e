#include <Eigen/Geometry>
#include <cmath>
#include <functional>

#include "improvement/quality/affine_fit.h"
#include "support/catch.h"

using namespace stackabilization;
using detail::AffineFit;
using detail::AffineMap;

namespace {

/// Points of a plate 10 x 6 of a thickness, on either side another grid of them.
Points plate(double thickness) {
  Points points(200, 3);
  for (Eigen::Index k = 0; k < 200; ++k) {
    const double side = k % 2 == 0 ? 0.5 : -0.5, i = static_cast<double>(k);
    points.row(k) << std::fmod(0.618034 * i, 1.0) * 10 - 5, std::fmod(0.754878 * i * i, 1.0) * 6 - 3,
        side * thickness;
  }
  return points;
}

Points mapped(Points points, const std::function<Eigen::Vector3d(const Eigen::Vector3d&)>& map) {
  for (Eigen::Index k = 0; k < points.rows(); ++k) points.row(k) = map(points.row(k).transpose()).transpose();
  return points;
}

}  // namespace

TEST_CASE("An affine map is found, whatever the points are", "[quality]") {
  Eigen::Matrix3d linear;
  linear << 1.1, 0.2, -0.3, 0, 0.9, 0.1, 0.2, -0.1, 1.3;
  const Eigen::Vector3d by(3, -2, 1);
  for (const double thickness : {6.0, 0.5, 0.01}) {
    const Points rest = plate(thickness);
    const AffineFit fit(rest);
    CHECK(fit.rank() == 3);
    const AffineMap map =
        fit.map(mapped(rest, [&](const Eigen::Vector3d& p) -> Eigen::Vector3d { return linear * p + by; }));
    CHECK((map.linear - linear).norm() < 1e-9);
    CHECK((map(Eigen::Vector3d::Zero()) - by).norm() < 1e-9);
  }
}

TEST_CASE("The taper and the bend of a plate leave its thickness where it is", "[quality]") {
  const Points rest = plate(0.2);
  const AffineFit fit(rest);
  const Points tapered = mapped(rest, [](const Eigen::Vector3d& p) {
    return Eigen::Vector3d(p.x(), p.y() * (1 + 0.04 * p.x()), p.z());
  });
  const Points bent = mapped(rest, [](const Eigen::Vector3d& p) {
    return Eigen::Vector3d(p.x(), p.y(), p.z() + 0.03 * p.x() * p.x());
  });
  for (const Points& now : {tapered, bent}) {
    const Eigen::Vector3d thin = fit.map(now).linear * Eigen::Vector3d::UnitZ();
    CHECK((thin - Eigen::Vector3d::UnitZ()).norm() < 1e-3);
  }
}

TEST_CASE("Faces of a plate that slide along each other leave its normal where it is", "[quality]") {
  const auto slid = [](const Points& rest, const Eigen::Matrix3d& turn) {
    return mapped(rest, [&](const Eigen::Vector3d& p) -> Eigen::Vector3d {
      return turn * Eigen::Vector3d(p.x() + 0.4 * p.z(), p.y(), 1.1 * p.z());
    });
  };
  const Eigen::Matrix3d turn =
      Eigen::AngleAxisd(0.3, Eigen::Vector3d(1, 2, 3).normalized()).toRotationMatrix();
  const Points rest = plate(0.2), cube = plate(6);
  const AffineFit fit(rest);
  const Eigen::Matrix3d stretched = turn * Eigen::Vector3d(1, 1, 1.1).asDiagonal();
  // The axes of uneven points lean by a thousandth.
  CHECK((fit.without_slide(fit.map(slid(rest, turn))) - stretched).norm() < 1e-2);
  const AffineMap of_cube = AffineFit(cube).map(slid(cube, turn));
  CHECK(AffineFit(cube).without_slide(of_cube) == of_cube.linear);
}

TEST_CASE("A flat part keeps its normal, and a curved sheet is fitted as it is", "[quality]") {
  const Points flat =
      mapped(plate(1), [](const Eigen::Vector3d& p) { return Eigen::Vector3d(p.x(), p.y(), 0); });
  CHECK(AffineFit(flat).rank() == 2);
  const Eigen::Matrix3d turn =
      Eigen::AngleAxisd(0.3, Eigen::Vector3d(1, 2, 3).normalized()).toRotationMatrix();
  CHECK((AffineFit(flat).map(flat * turn.transpose()).linear - turn).norm() < 1e-9);
  const Points sheet = mapped(
      plate(1), [](const Eigen::Vector3d& p) { return Eigen::Vector3d(p.x(), p.y(), 0.02 * p.x() * p.x()); });
  CHECK(AffineFit(sheet).rank() == 3);
  CHECK((AffineFit(sheet).map(sheet * turn.transpose()).linear - turn).norm() < 1e-9);
}
