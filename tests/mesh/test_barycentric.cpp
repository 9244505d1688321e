#include <random>

#include "mesh/barycentric.h"
#include "support/catch.h"
#include "support/solids.h"

using namespace stackabilization;
using detail::barycentric_weights;
using detail::point_at;

TEST_CASE("barycentric weights of a corner, an edge and the centroid are their closed forms") {
  const Shape shape = solids::tetrahedron({Eigen::Vector3d(1, 0, 0), Eigen::Vector3d(0, 5, 1),
                                           Eigen::Vector3d(-2, 1, 7), Eigen::Vector3d(3, 3, 3)});
  for (Eigen::Index t = 0; t < 4; ++t)
    for (const Eigen::Vector3d& weights : {Eigen::Vector3d(1, 0, 0), Eigen::Vector3d(0, 0.25, 0.75),
                                           Eigen::Vector3d(1.0 / 3, 1.0 / 3, 1.0 / 3)}) {
      const Eigen::Vector3d point = point_at(shape, t, weights);
      CHECK((barycentric_weights(shape, t, point) - weights).norm() == Approx(0).margin(1e-14));
    }
}

TEST_CASE("beside the plane the weights are those of the foot of the perpendicular") {
  const Shape box = solids::box({2, 3, 5});
  std::mt19937 random(1);
  std::uniform_real_distribution<double> any(-4, 4);
  for (int i = 0; i < 100; ++i) {
    const Eigen::Vector3d p(any(random), any(random), any(random));
    for (Eigen::Index t = 0; t < box.triangle_count(); ++t) {
      const Eigen::Vector3d weights = barycentric_weights(box, t, p), foot = point_at(box, t, weights);
      CHECK(weights.sum() == Approx(1));
      for (int k = 1; k < 3; ++k)
        CHECK((foot - p).dot(box.corner(t, k) - box.corner(t, 0)) == Approx(0).margin(1e-12));
    }
  }
}

TEST_CASE("weights do not care how large the triangle is") {
  Points points(3, 3);
  points << 0, 0, 0, 1, 0, 0, 0, 1, 0;
  Triangles triangles(1, 3);
  triangles << 0, 1, 2;
  for (const double size : {1e-50, 1e-12, 1.0, 1e12, 1e50}) {
    const Shape shape = make_shape(size * points, triangles);
    CHECK((barycentric_weights(shape, 0, {0.25 * size, 0.5 * size, 0}) - Eigen::Vector3d(0.25, 0.25, 0.5))
              .norm() == Approx(0).margin(1e-14));
  }
}
