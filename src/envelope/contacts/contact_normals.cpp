#include "envelope/contacts/contact_normals.h"

#include <Eigen/Geometry>

#include "core/bounding_diagonal.h"
#include "mesh/surface_moments.h"
#include "stackabilization/core/tolerances.h"

namespace stackabilization::detail {

/// A triangle at a point where copies touch.
struct ContactNormals::Touched {
  Eigen::Vector3d normal;  ///< unit, towards the copy above
  double slope = 0;        ///< normal . r: the sine of the angle between r and the triangle
  bool inside = false;     ///< whether the point is clear of the triangle's edges
};

ContactNormals::ContactNormals(const Shape& shape, const Direction& direction)
    : shape_(shape), up_(direction.unit()), reach_(tolerance::relative * bounding_diagonal(shape)) {}

std::optional<ContactNormals::Touched> ContactNormals::touched(Eigen::Index triangle,
                                                               const Eigen::Vector3d& point) const {
  const Eigen::Vector3d normal = unit_normal(shape_, triangle);
  if (!(normal.norm() > 0)) return std::nullopt;
  const double slope = normal.dot(up_);
  Touched result{slope < 0 ? Eigen::Vector3d(-normal) : normal, std::abs(slope), true};
  for (int k = 0; k < 3; ++k) {
    const Eigen::Vector3d from = shape_.corner(triangle, k);
    const Eigen::Vector3d edge = (shape_.corner(triangle, (k + 1) % 3) - from).normalized();
    result.inside &= normal.dot(edge.cross(point - from)) > reach_;
  }
  return result;
}

std::optional<Eigen::Vector3d> ContactNormals::normal(const ContactPolygon& polygon) const {
  // The copies touch where f is largest over the polygon.
  const Eigen::VectorXd f = (polygon.upper_points - polygon.lower_points) * up_;
  const double touching = f.maxCoeff() - reach_;
  Eigen::Vector3d below = Eigen::Vector3d::Zero(), above = Eigen::Vector3d::Zero();
  int count = 0;
  for (Eigen::Index k = 0; k < f.size(); ++k) {
    if (f(k) < touching) continue;
    below += polygon.upper_points.row(k).transpose();
    above += polygon.lower_points.row(k).transpose();
    ++count;
  }
  const auto upper = touched(polygon.upper_triangle, below / count);
  const auto lower = touched(polygon.lower_triangle, above / count);
  if (!upper || !lower) return std::nullopt;
  if (upper->inside != lower->inside) return upper->inside ? upper->normal : lower->normal;
  return (upper->slope < lower->slope) == upper->inside ? upper->normal : lower->normal;
}

}  // namespace stackabilization::detail
