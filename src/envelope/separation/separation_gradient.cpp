#include "stackabilization/envelope/separation_gradient.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <limits>
#include <vector>

#include "mesh/barycentric.h"
#include "stackabilization/core/errors.h"

namespace stackabilization {

namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;

/// Two triangles and the points of them that touch after the lift; corners are rows.
struct Touch {
  Matrix3d upper, lower;
  Vector3d upper_point, lower_point;
};

Matrix3d corners_of(const Shape& shape, Eigen::Index triangle) {
  Matrix3d corners;
  for (int i = 0; i < 3; ++i) corners.row(i) = shape.corner(triangle, i).transpose();
  return corners;
}

Vector3d edge(const Matrix3d& corners, int i) {
  return (corners.row((i + 1) % 3) - corners.row(i)).transpose();
}

bool is_degenerate(const Matrix3d& corners) {
  return edge(corners, 0).cross(edge(corners, 1)).isZero(0);
}

/// Normals that a plane between two triangles can have: of either one, or along an edge of each.
std::vector<Vector3d> possible_normals(const Touch& touch) {
  std::vector<Vector3d> normals = {edge(touch.upper, 0).cross(edge(touch.upper, 1)),
                                   edge(touch.lower, 0).cross(edge(touch.lower, 1))};
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j) normals.push_back(edge(touch.upper, i).cross(edge(touch.lower, j)));
  return normals;
}

/// How far the triangles reach through the plane through the touching points, model units.
double reach_through(const Touch& touch, const Vector3d& unit_normal) {
  const double above = (touch.upper * unit_normal).maxCoeff() - touch.upper_point.dot(unit_normal);
  const double below = touch.lower_point.dot(unit_normal) - (touch.lower * unit_normal).minCoeff();
  return std::max(above, below);
}

/// The normal n of the plane between the triangles, n.r = 1.
Vector3d plane_between(const Touch& touch, const Vector3d& r) {
  Vector3d best = Vector3d::Zero();
  double least = std::numeric_limits<double>::infinity();
  for (const Vector3d& candidate : possible_normals(touch)) {
    const Vector3d normal = candidate / candidate.dot(r);
    if (!normal.allFinite()) continue;
    const double reach = reach_through(touch, normal.normalized());
    if (reach >= least) continue;
    least = reach;
    best = normal;
  }
  return best;
}

}  // namespace

SeparationGradient separation_gradient(const Shape& below, const Shape& above, const Direction& direction,
                                       const Separation& separation) {
  if (!separation.blocked)
    throw UsageError("shapes that pass each other have no separation, and no gradient");
  const Witness& witness = separation.witness;
  const Touch touch{corners_of(below, witness.upper_triangle), corners_of(above, witness.lower_triangle),
                    witness.upper_point, witness.lower_point};
  if (is_degenerate(touch.upper) || is_degenerate(touch.lower))
    throw UsageError("a triangle without area attains the separation, which has no gradient there");
  const Vector3d weights_upper =
      detail::barycentric_weights(below, witness.upper_triangle, touch.upper_point);
  const Vector3d weights_lower =
      detail::barycentric_weights(above, witness.lower_triangle, touch.lower_point);
  const Vector3d& r = direction.vector();
  const double length = direction.length();
  const Vector3d normal = plane_between(touch, r);
  const double value = separation.value.to_double();
  return {length * weights_upper * normal.transpose(), -length * weights_lower * normal.transpose(),
          value * (r / length - length * normal)};
}

}  // namespace stackabilization
