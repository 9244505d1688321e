#include "mesh/surface_moments.h"

namespace stackabilization::detail {

SurfaceMoments::SurfaceMoments(const Shape& shape, const Eigen::Vector3d& origin) : origin_(origin) {
  for (Eigen::Index t = 0; t < shape.triangle_count(); ++t)
    add(shape.corner(t, 0), shape.corner(t, 1), shape.corner(t, 2));
}

void SurfaceMoments::add(const Eigen::Vector3d& a, const Eigen::Vector3d& b, const Eigen::Vector3d& c) {
  Eigen::Matrix3d corners;
  corners << a - origin_, b - origin_, c - origin_;
  const double area = area_vector(corners.col(0), corners.col(1), corners.col(2)).norm();
  const Eigen::Vector3d sum = corners.rowwise().sum();
  area_ += area;
  first_ += area / 3 * sum;
  second_ += area / 12 * (corners * corners.transpose() + sum * sum.transpose());
}

Eigen::Matrix3d SurfaceMoments::covariance() const {
  const Eigen::Vector3d mean = first_ / area_;
  return second_ / area_ - mean * mean.transpose();
}

}  // namespace stackabilization::detail
