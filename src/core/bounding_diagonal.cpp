#include "core/bounding_diagonal.h"

namespace stackabilization {

double bounding_diagonal(const Shape& shape) {
  Eigen::Vector3d extent;
  for (int a = 0; a < 3; ++a) extent(a) = range_along(shape, Eigen::Vector3d::Unit(a)).length();
  return extent.norm();
}

}  // namespace stackabilization
