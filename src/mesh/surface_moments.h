#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>

#include "stackabilization/core/shape.h"

namespace stackabilization::detail {

/// Returns the vector area of a triangle, half of (b - a) x (c - a), model units squared: its direction is
/// the normal, its length the area.
inline Eigen::Vector3d area_vector(const Eigen::Vector3d& a, const Eigen::Vector3d& b,
                                   const Eigen::Vector3d& c) {
  return (b - a).cross(c - a) / 2;
}

/// Returns the signed volume of the tetrahedron of a triangle and the origin, model units cubed: positive
/// where the normal of the triangle points away from the origin. Those of a closed surface sum to its volume.
inline double signed_volume(const Eigen::Vector3d& a, const Eigen::Vector3d& b, const Eigen::Vector3d& c) {
  return a.dot(b.cross(c)) / 6;
}

/// Returns the vector area of triangle `t` of a shape.
inline Eigen::Vector3d area_vector(const Shape& shape, Eigen::Index t) {
  return area_vector(shape.corner(t, 0), shape.corner(t, 1), shape.corner(t, 2));
}

/// Returns the unit normal of triangle `t` of a shape; zero if the triangle has no area.
inline Eigen::Vector3d unit_normal(const Shape& shape, Eigen::Index t) {
  return area_vector(shape, t).stableNormalized();
}

/// Returns whether triangle `t` of a shape has an area above 0 in double precision.
inline bool has_area(const Shape& shape, Eigen::Index t) {
  return area_vector(shape, t).squaredNorm() > 0;
}

/// Area and first and second moments of a surface of constant mass per area. Integrated over the triangles,
/// without sampling, so they have the symmetries of the surface.
class SurfaceMoments {
 public:
  /// Moments of no triangle. Integrals are relative to `origin`: a point near the surface keeps digits.
  explicit SurfaceMoments(const Eigen::Vector3d& origin) : origin_(origin) {}
  /// Moments of all triangles of a shape.
  SurfaceMoments(const Shape& shape, const Eigen::Vector3d& origin);

  /// Adds a triangle.
  void add(const Eigen::Vector3d& a, const Eigen::Vector3d& b, const Eigen::Vector3d& c);

  double area() const { return area_; }                      ///< model units squared
  const Eigen::Matrix3d& second() const { return second_; }  ///< integral of (p - origin) (p - origin)^T
  /// Returns the centroid, model units. Precondition, here and below: the area is above 0.
  Eigen::Vector3d centre() const { return origin_ + first_ / area_; }
  /// Returns the mean of (p - centre) (p - centre)^T, model units squared.
  Eigen::Matrix3d covariance() const;

 private:
  Eigen::Vector3d origin_;
  double area_ = 0;
  Eigen::Vector3d first_ = Eigen::Vector3d::Zero();
  Eigen::Matrix3d second_ = Eigen::Matrix3d::Zero();
};

}  // namespace stackabilization::detail
