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
#include "stackabilization/mesh/convex_hull.h"

namespace stackabilization::detail {

namespace {

struct Triangle {
  std::array<Eigen::Vector3d, 3> corners;

  double area() const { return (corners[1] - corners[0]).cross(corners[2] - corners[0]).norm() / 2; }
};

/// The boundary of a solid hull, a flat one cut from its middle to its sides, nothing for straight ones. Sums
/// over the triangles do not depend on how they are cut.
std::vector<Triangle> triangles_of(const HullFaces& hull) {
  std::vector<Triangle> triangles;
  if (hull.dimension == 3) {
    const TriangulatedHull solid = triangulated_hull(hull.points);
    for (const auto& t : solid.triangles.rowwise())
      triangles.push_back({{solid.points.row(t(0)).transpose(), solid.points.row(t(1)).transpose(),
                            solid.points.row(t(2)).transpose()}});
    return triangles;
  }
  const Eigen::Vector3d middle = hull.points.colwise().mean().transpose();
  for (const auto& side : hull.edges.rowwise())
    triangles.push_back(
        {{middle, hull.points.row(side(0)).transpose(), hull.points.row(side(1)).transpose()}});
  return triangles;
}

/// Second moment of a triangle about `centre`.
Eigen::Matrix3d moment(const Triangle& triangle, const Eigen::Vector3d& centre) {
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  Eigen::Matrix3d squares = Eigen::Matrix3d::Zero();
  for (const Eigen::Vector3d& corner : triangle.corners) {
    sum += corner - centre;
    squares += (corner - centre) * (corner - centre).transpose();
  }
  return triangle.area() / 12 * (squares + sum * sum.transpose());
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
  double area = 0;
  for (const Triangle& t : triangles) {
    area += t.area();
    spread.centre += t.area() / 3 * (t.corners[0] + t.corners[1] + t.corners[2]);
  }
  if (!(area > 0)) return with_ranges(straight_spread(std::move(spread)));
  spread.centre /= area;
  Eigen::Matrix3d sum = Eigen::Matrix3d::Zero();
  for (const Triangle& t : triangles) sum += moment(t, spread.centre);
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> solver(sum);
  for (int k = 0; k < 3; ++k) {
    spread.axes.col(k) = oriented(solver.eigenvectors().col(2 - k));
    spread.deviations(k) = std::sqrt(std::max(0.0, solver.eigenvalues()(2 - k) / area));
  }
  return with_ranges(spread);
}

}  // namespace stackabilization::detail
