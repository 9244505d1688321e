#include "mesh/principal_extents.h"

#include <Eigen/Eigenvalues>
#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <utility>
#include <vector>

#include "mesh/affine_span.h"
#include "mesh/hull_faces.h"
#include "mesh/surface_moments.h"
#include "stackabilization/mesh/convex_hull.h"

namespace stackabilization::detail {

namespace {

using Triangle = std::array<Eigen::Vector3d, 3>;

/// The boundary of a solid hull, a flat one cut from its middle to its sides, nothing for straight ones. Sums
/// over the triangles do not depend on how they are cut.
std::vector<Triangle> triangles_of(const HullFaces& hull) {
  std::vector<Triangle> triangles;
  if (hull.dimension == 3) {
    const TriangulatedHull solid = triangulated_hull(hull.points);
    for (const auto& t : solid.triangles.rowwise())
      triangles.push_back({solid.points.row(t(0)).transpose(), solid.points.row(t(1)).transpose(),
                           solid.points.row(t(2)).transpose()});
    return triangles;
  }
  const Eigen::Vector3d middle = hull.points.colwise().mean().transpose();
  for (const auto& side : hull.edges.rowwise())
    triangles.push_back({middle, hull.points.row(side(0)).transpose(), hull.points.row(side(1)).transpose()});
  return triangles;
}

SurfaceMoments moments_about(const std::vector<Triangle>& triangles, const Eigen::Vector3d& origin) {
  SurfaceMoments moments(origin);
  for (const auto& [a, b, c] : triangles) moments.add(a, b, c);
  return moments;
}

/// A direction by itself: its largest component is positive.
Eigen::Vector3d oriented(const Eigen::Vector3d& axis) {
  Eigen::Index largest = 0;
  axis.cwiseAbs().maxCoeff(&largest);
  return axis(largest) < 0 ? Eigen::Vector3d(-axis) : axis;
}

PrincipalExtents straight_spread(PrincipalExtents spread) {
  spread.centre = spread.hull.colwise().mean().transpose();
  const Eigen::Vector3d along = (spread.hull.bottomRows(1) - spread.hull.topRows(1)).transpose();
  spread.axes.col(0) = along.norm() > 0 ? oriented(along.normalized()) : Eigen::Vector3d::UnitX();
  spread.axes.col(1) = spread.axes.col(0).unitOrthogonal();
  spread.axes.col(2) = spread.axes.col(0).cross(spread.axes.col(1));
  spread.deviations.x() = along.norm() / std::sqrt(12.0);
  return spread;
}

PrincipalExtents with_ranges(PrincipalExtents spread) {
  const Points along = (spread.hull.rowwise() - spread.centre.transpose()) * spread.axes;
  spread.ranges << along.colwise().minCoeff().transpose(), along.colwise().maxCoeff().transpose();
  return spread;
}

PrincipalExtents scaled_by_power(PrincipalExtents spread, int exponent) {
  const auto scale = [exponent](double x) { return std::ldexp(x, exponent); };
  spread.centre = spread.centre.unaryExpr(scale).eval();
  spread.ranges = spread.ranges.unaryExpr(scale).eval();
  spread.deviations = spread.deviations.unaryExpr(scale).eval();
  spread.hull = spread.hull.unaryExpr(scale).eval();
  return spread;
}

}  // namespace

PrincipalExtents principal_extents(const Points& points, double resolution) {
  if (const int exponent = working_exponent(points); exponent != 0)
    return scaled_by_power(principal_extents(stackabilization::scaled_by_power(points, exponent),
                                             std::ldexp(resolution, exponent)),
                           -exponent);
  const HullFaces hull = hull_faces(points, resolution);
  const std::vector<Triangle> triangles = triangles_of(hull);
  PrincipalExtents spread;
  spread.hull = hull.points;
  const SurfaceMoments whole = moments_about(triangles, Eigen::Vector3d::Zero());
  if (!(whole.area() > 0)) return with_ranges(straight_spread(std::move(spread)));
  spread.centre = whole.centre();
  const SurfaceMoments centred = moments_about(triangles, spread.centre);
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> solver(centred.second());
  for (int k = 0; k < 3; ++k) {
    spread.axes.col(k) = oriented(solver.eigenvectors().col(2 - k));
    spread.deviations(k) = std::sqrt(std::max(0.0, solver.eigenvalues()(2 - k) / centred.area()));
  }
  return with_ranges(spread);
}

}  // namespace stackabilization::detail
