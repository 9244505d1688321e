#include <cmath>
#include <numbers>

#include "deformation/model/binding.h"
#include "deformation/model/mean_value_coordinates.h"
#include "deformation/model/skinning.h"
#include "deformation/model/transfer.h"
#include "support/catch.h"
#include "support/structures.h"
#include "support/variants.h"

using namespace stackabilization;

namespace {

using Weights = Eigen::Matrix<double, 8, 1>;

Eigen::Vector3d cube_corner(int k) {
  return {k & 1 ? 1.0 : -1.0, k & 2 ? 1.0 : -1.0, k & 4 ? 1.0 : -1.0};
}

Eigen::Vector3d reproduced(const Weights& weights) {
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  for (int k = 0; k < 8; ++k) sum += weights(k) * cube_corner(k);
  return sum;
}

double error(const Weights& a, const Weights& b) {
  return (a - b).cwiseAbs().maxCoeff();
}

Eigen::Quaterniond some_rotation(solids::Random& random) {
  return Eigen::Quaterniond(Eigen::AngleAxisd(random.uniform(-3, 3), random.on_sphere()));
}

/// Integral over the directions of the unit sphere, sampled: equation 2 of Ju et al. with the boundary values
/// 0, 1 of a corner, interpolated over the two triangulations of each square in turn.
Weights sampled_coordinates(const Eigen::Vector3d& point, int count) {
  Weights sum = Weights::Zero();
  for (int i = 0; i < count; ++i) {
    const double z = 1 - (2.0 * i + 1) / count, angle = i * std::numbers::pi * (3 - std::sqrt(5.0));
    const Eigen::Vector3d ray(std::sqrt(1 - z * z) * std::cos(angle), std::sqrt(1 - z * z) * std::sin(angle),
                              z);
    double distance = std::numeric_limits<double>::infinity();
    for (int a = 0; a < 3; ++a)
      if (ray(a) != 0) distance = std::min(distance, ((ray(a) > 0 ? 1 : -1) - point(a)) / ray(a));
    sum += cube_coordinates(point + distance * ray) / distance;
  }
  return sum / sum.sum();
}

Primitive moved_primitive(Primitive primitive, const Eigen::Matrix3d& linear, const Eigen::Vector3d& by,
                          double radius_factor) {
  const auto move = [&](auto& points) {
    points = ((points * linear.transpose()).rowwise() + by.transpose()).eval();
  };
  if (auto* cuboid = std::get_if<Cuboid>(&primitive)) {
    move(cuboid->corners);
  } else {
    auto& cylinder = std::get<GeneralizedCylinder>(primitive);
    move(cylinder.centres);
    cylinder.radii *= radius_factor;
    cylinder.rotation = Eigen::Quaterniond(linear / radius_factor);
  }
  return primitive;
}

std::vector<GeneralizedCylinder> cylinders() {
  GeneralizedCylinder helix;
  helix.centres.resize(20, 3);
  helix.radii.resize(20);
  for (int i = 0; i < 20; ++i) {
    helix.centres.row(i) << 2 * std::cos(0.4 * i), 2 * std::sin(0.4 * i), 0.2 * i;
    helix.radii(i) = 0.3 + 0.01 * i;
  }
  return {structures::straight_cylinder({1, 2, 3}, {4, -1, 2}, 0.7, 6),
          structures::arc_cylinder(3, 0.4, -1.5, 2, 9), structures::ring_cylinder(3, 0.5, 14), helix};
}

}  // namespace

TEST_CASE("mean value coordinates sum to one and reproduce the point, in and outside of the cube") {
  solids::Random random(7);
  for (int trial = 0; trial < 3000; ++trial) {
    Eigen::Vector3d point = random.uniform(0.1, 4) * random.in_cube();
    if (random.below(10) == 0) point *= 1e3;
    // Near faces, edges and corners, down to rounding, inside and outside.
    for (double& x : point)
      if (random.below(3) == 0)
        x = std::copysign(1 + random.uniform(-1, 1) * std::pow(10.0, -static_cast<double>(random.below(17))),
                          x);
    const Weights weights = cube_coordinates(point);
    INFO("point " << point.transpose());
    REQUIRE(std::abs(weights.sum() - 1) < 1e-12 * std::max(1.0, point.norm()));
    REQUIRE((reproduced(weights) - point).norm() < 1e-12 * std::max(1.0, point.norm()));
    if (point.cwiseAbs().maxCoeff() <= 1) REQUIRE(weights.minCoeff() > -1e-9);
  }
}

TEST_CASE("mean value coordinates are the normalised integral of their definition") {
  for (const Eigen::Vector3d& point : {Eigen::Vector3d(0.2, -0.4, 0.1), Eigen::Vector3d(0.7, 0.6, -0.5)})
    CHECK(error(cube_coordinates(point), sampled_coordinates(point, 200000)) < 2e-4);
}

TEST_CASE("mean value coordinates have closed forms at corners, on edges and on faces") {
  for (int k = 0; k < 8; ++k) CHECK(cube_coordinates(cube_corner(k)) == Weights(Weights::Unit(k)));
  Weights edge = Weights::Zero();  // from corner 1 to corner 5
  edge(1) = 0.35;
  edge(5) = 0.65;
  CHECK(error(cube_coordinates({1, -1, 0.3}), edge) < 1e-15);
  Weights face = Weights::Zero();  // x = 1, (y, z) = (0.5, -0.2), corners 1, 3, 5, 7
  // Diagonal 1-7: triangle 1, 3, 7. Diagonal 3-5: triangle 1, 3, 5 would need y + z <= 0, so it is 3, 7, 5.
  face(1) = 0.25 / 2;
  face(3) = (0.35 + 0.6) / 2;
  face(7) = (0.4 + 0.15) / 2;
  face(5) = 0.25 / 2;
  CHECK(error(cube_coordinates({1, 0.5, -0.2}), face) < 1e-15);
}

TEST_CASE("mean value coordinates approach their values on faces, edges and corners") {
  for (const Eigen::Vector3d& border : {Eigen::Vector3d(1, 0.5, -0.2), Eigen::Vector3d(1, 0.3, 0.3),
                                        Eigen::Vector3d(-1, 1, 0.25), Eigen::Vector3d(1, -1, 1)})
    for (double distance = 1e-3; distance > 1e-15; distance /= 10)
      for (const double side : {-1.0, 1.0}) {
        Eigen::Vector3d point = border;
        for (double& x : point)
          if (std::abs(x) == 1) x *= 1 + side * distance;
        CHECK(error(cube_coordinates(point), cube_coordinates(border)) < 40 * distance + 2e-9);
      }
}

TEST_CASE("mean value coordinates have the symmetries of the cube") {
  solids::Random random(3);
  for (int trial = 0; trial < 100; ++trial) {
    const Eigen::Vector3d point = 1.5 * random.in_cube();
    const Weights weights = cube_coordinates(point);
    const Weights mirrored = cube_coordinates({-point.x(), point.y(), point.z()});
    const Weights swapped = cube_coordinates({point.y(), point.x(), point.z()});
    for (int k = 0; k < 8; ++k) {
      CHECK(std::abs(weights(k) - mirrored(k ^ 1)) < 1e-12);
      CHECK(std::abs(weights(k) - swapped((k & 4) | (k & 1) << 1 | (k & 2) >> 1)) < 1e-12);
    }
  }
}

TEST_CASE("points ride on a cuboid affinely, however thin it is") {
  solids::Random random(11);
  for (const double thickness : {1.0, 1e-2, 1e-5, 0.0}) {
    const Eigen::Vector3d half(2, thickness, 0.5);
    const Cuboid rest = cuboid_of({{5, 6, 7}, some_rotation(random).toRotationMatrix(), half});
    const Eigen::Matrix3d linear = Eigen::Matrix3d::Identity() + 0.3 * Eigen::Matrix3d::Ones();
    const Eigen::Vector3d by(1, -2, 0.5);
    for (int trial = 0; trial < 50; ++trial) {
      // Within twice the box; far beyond a thin one, where it has a thickness.
      Eigen::Vector3d point = rest.corners.colwise().mean().transpose();
      for (int a = 0; a < 3; ++a)
        point += random.uniform(-1, 1) * (rest.corners.row(1 << a) - rest.corners.row(0)).transpose();
      if (thickness > 0) point += 0.01 * random.in_cube();
      CHECK(deform_point(rest, rest, point) == point);
      CHECK((deform_point(rest, moved_primitive(rest, linear, by, 1), point) - (linear * point + by)).norm() <
            1e-12 * 40);
    }
  }
}

TEST_CASE("points ride on generalized cylinders exactly through rest, rigid motions and uniform scalings") {
  solids::Random random(5);
  for (const GeneralizedCylinder& rest : cylinders()) {
    const Eigen::Quaterniond rotation = some_rotation(random);
    const Eigen::Vector3d by = 3 * random.in_cube();
    for (int trial = 0; trial < 200; ++trial) {
      const Eigen::Vector3d point = 4 * random.in_cube();
      CHECK((deform_point(rest, rest, point) - point).norm() < 1e-13);
      for (const double factor : {1.0, 0.8, 1.7}) {
        const Eigen::Matrix3d linear = factor * rotation.toRotationMatrix();
        CHECK((deform_point(rest, moved_primitive(rest, linear, by, factor), point) - (linear * point + by))
                  .norm() < 1e-12 * 20);
      }
    }
  }
}

TEST_CASE("far from the origin points ride as exactly as their coordinates allow") {
  GeneralizedCylinder rest = structures::arc_cylinder(1, 0.1, 0, 2, 7);
  rest.centres.rowwise() += Eigen::RowVector3d(1e4, -2e4, 3e4);
  GeneralizedCylinder now = rest;
  now.centres.rowwise() += Eigen::RowVector3d(0.5, 0, 0);
  const Eigen::Vector3d point(1e4 + 1, -2e4 + 0.1, 3e4);
  CHECK((deform_point(rest, now, point) - point - Eigen::Vector3d(0.5, 0, 0)).norm() < 1e-11);
}

TEST_CASE("a scaled cross-section scales what lies across the curve and leaves the ends where they are") {
  const GeneralizedCylinder rest = structures::straight_cylinder({0, 0, 0}, {0, 0, 4}, 1, 5);
  GeneralizedCylinder now = rest;
  now.radii << 1, 2, 3, 2, 0.5;
  CHECK((deform_point(rest, now, {0.5, 0, 2}) - Eigen::Vector3d(1.5, 0, 2)).norm() < 1e-14);
  CHECK((deform_point(rest, now, {0, 1, 1.5}) - Eigen::Vector3d(0, 2.5, 1.5)).norm() < 1e-14);
  CHECK((deform_point(rest, now, {1, 0, 4.25}) - Eigen::Vector3d(0.5, 0, 4.25)).norm() <
        1e-14);  // beyond the end
}

TEST_CASE("a bent curve carries the plane of each section rigidly and what lies between without a step") {
  const GeneralizedCylinder rest = structures::straight_cylinder({0, 0, 0}, {0, 0, 6}, 1, 7);
  GeneralizedCylinder now = rest;
  for (int i = 0; i < 7; ++i) now.centres.row(i) << 6 - 6 * std::cos(0.2 * i), 0, 6 * std::sin(0.2 * i);
  const Points tangents = section_tangents(now);
  for (int i = 0; i < 7; ++i) {
    const Eigen::Vector3d point(0.3, 0.8, i), c = now.centres.row(i).transpose(),
                                              t = tangents.row(i).transpose();
    const Eigen::Vector3d image = deform_point(rest, now, point);
    CHECK(std::abs((image - c).norm() - std::hypot(0.3, 0.8)) < 1e-13);
    CHECK(std::abs((image - c).dot(t)) < 1e-13);
    CHECK(std::abs(image.y() - 0.8) < 1e-13);
    CHECK((deform_point(rest, now, {0.3, 0.8, i - 1e-9}) - deform_point(rest, now, {0.3, 0.8, i + 1e-9}))
              .norm() < 1e-8);
  }
}

TEST_CASE("around a bend of a curve at rest, places vary without a jump from section to section") {
  const GeneralizedCylinder rest = structures::arc_cylinder(3, 1, 0, 3, 7);
  GeneralizedCylinder now = rest;
  now.centres.rowwise() -= Eigen::RowVector3d(0, 0, 1);
  for (int i = 0; i < 7; ++i) now.centres(i, 1) += 0.1 * i * i, now.radii(i) = 1 + 0.1 * i;
  // Straight across the bend, inside of the curve: nearest points of the polyline would jump over each
  // corner.
  for (double angle = 0.05; angle < 2.95; angle += 0.001) {
    const auto at = [](double a) { return Eigen::Vector3d(2.2 * std::cos(a), 0.2, 2.2 * std::sin(a)); };
    CHECK((deform_point(rest, now, at(angle + 0.001)) - deform_point(rest, now, at(angle))).norm() < 0.01);
  }
}

TEST_CASE("dual quaternions blend along the shorter way") {
  const Eigen::Quaterniond a(Eigen::AngleAxisd(0.2, Eigen::Vector3d::UnitZ()));
  const Eigen::Quaterniond b(Eigen::AngleAxisd(0.8, Eigen::Vector3d::UnitZ()));
  const Eigen::Quaterniond minus_b(-b.w(), -b.x(), -b.y(), -b.z());
  const Eigen::Vector3d p(1, 2, 3), t(0.5, 0, 1);
  const Eigen::Vector3d half = blended(dual_quaternion(a, t), dual_quaternion(b, t), 0.5, p);
  CHECK((blended(dual_quaternion(a, t), dual_quaternion(minus_b, t), 0.5, p) - half).norm() < 1e-15);
  CHECK((blended(dual_quaternion(a, t), dual_quaternion(b, t), 0, p) - (a * p + t)).norm() < 1e-14);
  CHECK((blended(dual_quaternion(a, t), dual_quaternion(b, t), 1, p) - (b * p + t)).norm() < 1e-14);
  // Half way between two rotations about parallel axes is the mean rotation about one.
  const Eigen::Vector3d turned =
      blended(dual_quaternion(a, {0, 0, 0}), dual_quaternion(b, {0, 0, 0}), 0.5, p);
  CHECK((turned - Eigen::AngleAxisd(0.5, Eigen::Vector3d::UnitZ()) * p).norm() < 1e-14);
  CHECK(smallest_rotation(t.normalized(), t.normalized()).vec().isZero(0));
  const Eigen::Quaterniond opposite = smallest_rotation({0, 0, 1}, {0, 0, -1});
  CHECK((opposite * Eigen::Vector3d(0, 0, 1) - Eigen::Vector3d(0, 0, -1)).norm() < 1e-15);
}

TEST_CASE("the jacobian of a carried point is that of central differences") {
  solids::Random random(9);
  for (const GeneralizedCylinder& rest : cylinders()) {
    const detail::PrimitiveBinding carrier(rest);
    GeneralizedCylinder now = rest;
    for (double& x : now.centres.reshaped()) x += random.uniform(-0.05, 0.05);
    for (double& r : now.radii) r *= random.uniform(0.9, 1.1);
    const detail::PointBinding binding =
        carrier.bind(Eigen::Vector3d(rest.centres.row(2).transpose() + 0.2 * random.in_cube()));
    const detail::ControlJacobian jacobian = carrier.jacobian(binding, now);
    Eigen::MatrixXd dense = Eigen::MatrixXd::Zero(3, 4 * rest.centres.rows());
    for (const auto& [point, block] : jacobian.points) dense.middleCols<3>(3 * point) = block;
    for (const auto& [section, column] : jacobian.radii)
      dense.col(3 * rest.centres.rows() + section) = column;
    for (Eigen::Index k = 0; k < dense.cols(); ++k) {
      const auto at = [&](double step) {
        GeneralizedCylinder varied = now;
        (k < 3 * rest.centres.rows() ? varied.centres(k / 3, k % 3)
                                     : varied.radii(k - 3 * rest.centres.rows())) += step;
        return carrier.position_of(binding, varied);
      };
      CHECK((dense.col(k) - (at(1e-5) - at(-1e-5)) / 2e-5).norm() < 1e-5);
    }
  }
}
