#include <Eigen/Geometry>
#include <numeric>

#include "deformation/iwires/wire_fit.h"
#include "support/catch.h"
#include "support/point_sets.h"

namespace stackabilization::wire_fit_test {

using namespace detail;

namespace {

using Positions = std::vector<Eigen::Vector3d>;

std::vector<int> all_of(const Positions& points) {
  std::vector<int> rows(points.size());
  std::iota(rows.begin(), rows.end(), 0);
  return rows;
}

Positions mapped(const Positions& points, const Eigen::Affine3d& map) {
  Positions result;
  for (const Eigen::Vector3d& p : points) result.push_back(map * p);
  return result;
}

Eigen::Affine3d random_map(point_sets::Random& random) {
  Eigen::Affine3d map = Eigen::Affine3d::Identity();
  for (double& factor : map.linear().reshaped()) factor += random.uniform(-0.4, 0.4);
  map.translation() = random.vector(3);
  return map;
}

/// Combinations of the columns of `directions`, about (1, 2, 3).
template <int Dimension>
Positions spanned(const Eigen::Matrix<double, 3, Dimension>& directions, point_sets::Random& random) {
  Positions points;
  for (int k = 0; k < 8; ++k) {
    Eigen::Vector3d p(1, 2, 3);
    for (int c = 0; c < Dimension; ++c) p += random.uniform(-1, 1) * directions.col(c);
    points.push_back(p);
  }
  return points;
}

}  // namespace

TEST_CASE("an affine map of points that span space is found exactly") {
  point_sets::Random random(3);
  for (int trial = 0; trial < 20; ++trial) {
    const Positions rest = spanned<3>(Eigen::Matrix3d::Identity(), random);
    const Eigen::Affine3d map = random_map(random);
    const WireFit fit(all_of(rest), rest);
    CHECK((fit.linear(mapped(rest, map)) - map.linear()).norm() < 1e-12);
    CHECK((fit.moved_centre(mapped(rest, map)) - map * fit.centre()).norm() < 1e-13);
    CHECK(fit.linear(rest).isIdentity(1e-13));
  }
}

TEST_CASE("of a plane what it spans is found exactly, and its normal becomes the normal of the image") {
  point_sets::Random random(5);
  for (int trial = 0; trial < 20; ++trial) {
    Eigen::Matrix<double, 3, 2> plane;
    plane << random.unit(), random.unit();
    if (plane.col(0).cross(plane.col(1)).norm() < 0.5) continue;
    const Positions rest = spanned<2>(plane, random);
    const Eigen::Affine3d map = random_map(random);
    const Eigen::Matrix3d found = WireFit(all_of(rest), rest).linear(mapped(rest, map));
    CHECK((found * plane - map.linear() * plane).norm() < 1e-11);
    const Eigen::Vector3d normal = plane.col(0).cross(plane.col(1)).normalized(),
                          image =
                              (map.linear() * plane.col(0)).cross(map.linear() * plane.col(1)).normalized();
    CHECK((found * normal - image).norm() < 1e-11);
  }
}

TEST_CASE("of a line its stretch is found, and what is across turns with it without one") {
  point_sets::Random random(7);
  for (int trial = 0; trial < 20; ++trial) {
    const Eigen::Vector3d along = random.unit();
    const Positions rest = spanned<1>(along, random);
    const Eigen::Affine3d map = random_map(random);
    const Eigen::Matrix3d found = WireFit(all_of(rest), rest).linear(mapped(rest, map));
    const Eigen::Vector3d image = map.linear() * along;
    CHECK((found * along - image).norm() < 1e-12);
    Eigen::Matrix<double, 3, 2> across;
    across << along.unitOrthogonal(), along.cross(along.unitOrthogonal());
    const Eigen::Matrix<double, 3, 2> turned = found * across;
    CHECK((turned.transpose() * turned).isIdentity(1e-12));
    CHECK((turned.transpose() * image).norm() < 1e-12);
    CHECK(found.determinant() == Approx(image.norm()).epsilon(1e-12));
  }
}

TEST_CASE("one point has no linear map, nor has one that is repeated") {
  const Positions rest(3, Eigen::Vector3d(1, 2, 3));
  for (const std::vector<int>& members : {std::vector<int>{1}, std::vector<int>{0, 1, 2}}) {
    const WireFit fit(members, rest);
    CHECK(fit.centre() == Eigen::Vector3d(1, 2, 3));
    CHECK(fit.linear({{0, 0, 0}, {5, 5, 5}, {0, 1, 0}}) == Eigen::Matrix3d::Identity());
  }
}

TEST_CASE("points that fit no map leave a residual across all that they span") {
  point_sets::Random random(11);
  const Positions rest = spanned<3>(Eigen::Matrix3d::Identity(), random);
  Positions moved = mapped(rest, random_map(random));
  for (Eigen::Vector3d& p : moved) p += random.vector(0.3);
  const WireFit fit(all_of(rest), rest);
  const Eigen::Matrix3d linear = fit.linear(moved);
  Eigen::Matrix3d normal_equations = Eigen::Matrix3d::Zero();
  for (std::size_t k = 0; k < rest.size(); ++k) {
    const Eigen::Vector3d arm = rest[k] - fit.centre();
    normal_equations += (moved[k] - fit.moved_centre(moved) - linear * arm) * arm.transpose();
  }
  CHECK(normal_equations.norm() < 1e-12);
}

TEST_CASE("only members count, and what is thinner than a twentieth is flat") {
  Positions rest = {{1, 0, 0}, {-1, 0, 0}, {0, 1, 0}, {0, -1, 0}, {9, 9, 9}};
  const auto of_thickness = [&](double thickness) {
    rest[2].z() = rest[3].z() = thickness;
    const Positions tall = mapped(rest, Eigen::Affine3d(Eigen::Scaling(1.0, 1.0, 4.0)));
    return WireFit({0, 1, 2, 3}, rest).linear(tall)(2, 2);
  };
  // Heights of +-half the thickness, lengths of +-1 at two of four points.
  CHECK(of_thickness(0.2) == Approx(4).epsilon(1e-9));
  CHECK(of_thickness(0.01) == Approx(1).epsilon(1e-3));
}

}  // namespace stackabilization::wire_fit_test
