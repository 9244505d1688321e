#include "stackabilization/improvement/shape_change.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

#include "mesh/used_vertices.h"
#include "numerics/polar_decomposition.h"
#include "stackabilization/core/errors.h"

namespace stackabilization {

namespace {

/// Returns the rotation times scale factor that maps `from` to `to` (both n x 3, centred) with least squared
/// distances: Umeyama 1991, Eq. 40 to 43. 0 where all points of `from` coincide.
Eigen::Matrix3d similarity(const Points& from, const Points& to) {
  const double spread = from.squaredNorm();
  if (!(spread > 0)) return Eigen::Matrix3d::Zero();
  const detail::PolarDecomposition polar = detail::polar_decomposition(to.transpose() * from);
  return polar.rotation * (polar.factors.sum() / spread);
}

}  // namespace

Points displacements(const Shape& before, const Shape& after) {
  if (before.vertex_count() != after.vertex_count() || before.triangle_count() != after.triangle_count() ||
      before.triangles != after.triangles)
    throw UsageError("shapes can be compared only when they have the same vertices and triangles");
  if (before.triangle_count() == 0) return Points(0, 3);
  Points target = used_vertices(before), moved = used_vertices(after);
  const double diagonal = (target.colwise().maxCoeff() - target.colwise().minCoeff()).norm();
  // Lengths are divided by the larger diagonal, so that no square overflows or underflows.
  const double unit = std::max(diagonal, (moved.colwise().maxCoeff() - moved.colwise().minCoeff()).norm());
  if (!(diagonal > 0)) return Points(0, 3);
  for (Points* points : {&target, &moved}) {
    const Eigen::RowVector3d middle = points->colwise().mean();
    *points = (points->rowwise() - middle) / unit;
  }
  return (moved * similarity(moved, target).transpose() - target) * (unit / diagonal);
}

double root_mean_square(const Points& vectors) {
  return vectors.rows() == 0 ? 0 : vectors.norm() / std::sqrt(static_cast<double>(vectors.rows()));
}

ShapeChange shape_change(const Shape& before, const Shape& after) {
  const Points moved = displacements(before, after);
  if (moved.rows() == 0) return {};
  return {root_mean_square(moved), moved.rowwise().norm().maxCoeff()};
}

}  // namespace stackabilization
