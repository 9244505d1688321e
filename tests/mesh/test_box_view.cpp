#include <Eigen/Geometry>
#include <cmath>

#include "mesh/box_view.h"
#include "support/catch.h"
#include "support/point_sets.h"

using namespace stackabilization;
using detail::BoxView;
using point_sets::Random;

namespace {

double box_volume(const HullSupport& hull, const Eigen::Vector3d& normal) {
  return hull.box_along(Direction(normal)).volume();
}

/// A direction at `angle` from another one.
Eigen::Vector3d turned(const Eigen::Vector3d& normal, double angle, Random& random) {
  const Eigen::Vector3d across = normal.cross(random.unit()).normalized();
  return normal * std::cos(angle) + across * std::sin(angle);
}

}  // namespace

TEST_CASE("a view has the volume of the box along it, in every unit") {
  Random random(1);
  for (const Points& points : {point_sets::in_ball(40, 3), point_sets::frustum(32, 1, 1.4, 2),
                               point_sets::box({1, 2, 3}), point_sets::tetrahedron()}) {
    const HullSupport hull(points);
    for (int i = 0; i < 50; ++i) {
      const Eigen::Vector3d normal = random.unit();
      CHECK(BoxView(hull, normal, 1).volume() == Approx(box_volume(hull, normal)).epsilon(1e-12));
      CHECK(BoxView(hull, normal, 4).volume() == Approx(64 * box_volume(hull, normal)).epsilon(1e-12));
    }
    // Along the normal of a face many corners are equally high, and sides of the outline parallel.
    for (Eigen::Index f = 0; f < hull.face_normals().rows(); ++f) {
      const Eigen::Vector3d normal = hull.face_normals().row(f).transpose();
      CHECK(BoxView(hull, normal, 1).volume() == Approx(box_volume(hull, normal)).epsilon(1e-12));
    }
  }
}

TEST_CASE("no box is smaller than what a view from elsewhere says, and nearby it hardly says less") {
  Random random(2);
  for (const Points& points : {point_sets::in_ball(40, 4), point_sets::frustum(32, 1, 1.4, 2),
                               point_sets::box({1, 2, 3}), point_sets::on_sphere(200, 5)}) {
    const HullSupport hull(points);
    for (int i = 0; i < 200; ++i) {
      const Eigen::Vector3d normal = random.unit();
      const BoxView view(hull, normal, 1);
      for (const double angle : {1e-6, 1e-3, 0.1, 0.5, 1.5}) {
        const Eigen::Vector3d other = turned(normal, angle, random);
        CHECK(view.bound_along(other) <= box_volume(hull, other) * (1 + 1e-12));
      }
      CHECK(view.bound_along(normal) == Approx(view.volume()).epsilon(1e-12));
      const Eigen::Vector3d beside = turned(normal, 1e-6, random);
      CHECK(view.bound_along(beside) >= box_volume(hull, beside) * (1 - 1e-8));
    }
  }
}

TEST_CASE("no box within an angle of a view is smaller than it says") {
  Random random(3);
  for (const Points& points : {point_sets::in_ball(40, 6), point_sets::frustum(32, 1, 1.4, 2),
                               point_sets::box({1, 2, 3}), point_sets::tetrahedron()}) {
    const HullSupport hull(points);
    for (int i = 0; i < 100; ++i) {
      const Eigen::Vector3d normal = random.unit();
      const BoxView view(hull, normal, 1);
      for (const double angle : {1e-4, 0.05, 0.2}) {
        const double bound = view.bound_within(angle);
        CHECK(bound <= view.volume());
        if (angle < 0.1) CHECK(bound >= view.volume() * (1 - 20 * angle));
        for (int k = 0; k < 20; ++k)
          CHECK(bound <= box_volume(hull, turned(normal, random.uniform(0, angle), random)) * (1 + 1e-12));
      }
    }
  }
}

TEST_CASE("what is seen edge on bounds nothing") {
  const HullSupport flat(point_sets::box({1, 2, 0}));
  const BoxView view(flat, Eigen::Vector3d::UnitX(), 1);
  CHECK(view.volume() == 0);
  CHECK(view.bound_along(Eigen::Vector3d::UnitX()) == 0);
  CHECK(view.bound_within(0.1) == 0);
}
