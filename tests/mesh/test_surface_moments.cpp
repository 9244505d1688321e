#include <Eigen/Geometry>
#include <cmath>

#include "mesh/surface_moments.h"
#include "support/catch.h"
#include "support/solids.h"
#include "support/variants.h"

using namespace stackabilization;
using detail::area_vector;
using detail::SurfaceMoments;

TEST_CASE("the vector areas of a closed surface sum to zero, and each is its area along its normal") {
  for (const Shape& shape : {solids::box({1, 2, 3}), solids::cylinder(1, 2, 12), solids::torus({})}) {
    Eigen::Vector3d sum = Eigen::Vector3d::Zero();
    for (Eigen::Index t = 0; t < shape.triangle_count(); ++t) {
      sum += area_vector(shape, t);
      CHECK((detail::unit_normal(shape, t) * area_vector(shape, t).norm() - area_vector(shape, t)).norm() <
            1e-14);
      CHECK(detail::has_area(shape, t));
    }
    CHECK(sum.norm() < 1e-12);
  }
  Points points(3, 3);
  points << 0, 0, 0, 1, 1, 1, 2, 2, 2;
  Triangles triangles(1, 3);
  triangles << 0, 1, 2;
  const Shape needle = make_shape(points, triangles);
  CHECK_FALSE(detail::has_area(needle, 0));
  CHECK(detail::unit_normal(needle, 0).isZero(0));
}

TEST_CASE("surface moments are those of the solid's faces, about any origin") {
  const Shape box = solids::box({1, 2, 3}, {3, 8, 4});
  for (const Eigen::Vector3d& origin : {Eigen::Vector3d(0, 0, 0), Eigen::Vector3d(2, 5, 3.5), {-7, 30, 1}}) {
    const SurfaceMoments moments(box, origin);
    CHECK(moments.area() == Approx(2 * (12 + 6 + 2)));
    CHECK((moments.centre() - Eigen::Vector3d(2, 5, 3.5)).norm() == Approx(0).margin(1e-12));
    // Across x: the faces x = const (6 each) lie 1 away, the others (28 in all) have a third of that,
    // squared.
    CHECK(moments.covariance()(0, 0) == Approx((12 * 1 + 28 / 3.0) / 40));
    CHECK(moments.covariance()(0, 1) == Approx(0).margin(1e-10));
    // The parallel axis theorem.
    const Eigen::Vector3d offset = moments.centre() - origin;
    CHECK((moments.second() / moments.area() - moments.covariance() - offset * offset.transpose()).norm() <
          1e-11 * (1 + offset.squaredNorm()));
  }
}

TEST_CASE("surface moments turn with the surface, and do not depend on how it is cut") {
  const Shape torus = solids::torus({});
  const Eigen::Matrix3d turn = solids::random_rotation(5);
  const Eigen::Vector3d shift(3, -2, 11);
  const Shape moved = transformed(torus, turn, shift);
  const SurfaceMoments before(torus, torus.corner(0, 0)), after(moved, moved.corner(0, 0));
  CHECK(after.area() == Approx(before.area()));
  CHECK((after.centre() - turn * before.centre() - shift).norm() < 1e-12);
  CHECK((after.covariance() - turn * before.covariance() * turn.transpose()).norm() < 1e-11);

  const Eigen::Vector3d a(0, 0, 0), b(3, 1, 0), c(1, 4, 2), inside = 0.2 * a + 0.5 * b + 0.3 * c;
  SurfaceMoments whole(a), cut(a);
  whole.add(a, b, c);
  cut.add(a, b, inside);
  cut.add(b, c, inside);
  cut.add(c, a, inside);
  CHECK(cut.area() == Approx(whole.area()));
  CHECK((cut.centre() - whole.centre()).norm() < 1e-14);
  CHECK((cut.covariance() - whole.covariance()).norm() < 1e-14);
}
