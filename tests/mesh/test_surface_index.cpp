#include "mesh/surface_index.h"
#include "stackabilization/core/errors.h"
#include "support/catch.h"
#include "support/solids.h"

using namespace stackabilization;

TEST_CASE("the nearest point of a box is the clamped point outside and the nearest wall inside") {
  const SurfaceIndex index(solids::box({2, 3, 4}));
  for (const Eigen::Vector3d& p :
       {Eigen::Vector3d(5, 1, 1), Eigen::Vector3d(-1, -2, 9), Eigen::Vector3d(1, 7, -3)}) {
    const Eigen::Vector3d clamped = p.cwiseMax(Eigen::Vector3d::Zero()).cwiseMin(Eigen::Vector3d(2, 3, 4));
    CHECK((index.nearest(p).point - clamped).norm() == Approx(0).margin(1e-14));
    CHECK(index.nearest(p).distance == Approx((p - clamped).norm()));
  }
  CHECK(index.nearest({0.25, 1.5, 2}).distance == Approx(0.25));
}

TEST_CASE("samples stand for equal areas, whatever the triangles") {
  const Shape shape = solids::box({1, 2, 3});
  const SurfaceSamples samples = surface_samples(shape, 2200);
  // Faces of area 2, 3, 6 twice, 22 in all: 100 samples per unit of area.
  for (int axis = 0; axis < 3; ++axis)
    for (int side = -1; side <= 1; side += 2) {
      int count = 0;
      Eigen::Vector3d mean = Eigen::Vector3d::Zero();
      for (Eigen::Index k = 0; k < samples.points.rows(); ++k)
        if (samples.normals(k, axis) * side > 0.5) ++count, mean += samples.points.row(k).transpose();
      const double area = axis == 0 ? 6 : axis == 1 ? 3 : 2;
      CHECK(std::abs(count - 100 * area) <= 1);
      mean /= count;
      for (int other = 0; other < 3; ++other)
        if (other != axis) CHECK(mean(other) == Approx((other + 1) / 2.0).epsilon(0.05));
    }
}

TEST_CASE("a surface without area has no nearest point and no samples") {
  Points points(3, 3);
  points << 0, 0, 0, 1, 1, 1, 2, 2, 2;
  Triangles triangles(1, 3);
  triangles << 0, 1, 2;
  const Shape sliver = make_shape(points, triangles);
  CHECK_THROWS_AS(SurfaceIndex(sliver), InputError);
  CHECK_THROWS_AS(surface_samples(sliver, 10), InputError);
}
