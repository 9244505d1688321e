#pragma once

#include <Eigen/Core>

#include "stackabilization/core/shape.h"

namespace stackabilization::detail {

/// Returns the diagonal of the axis-parallel box around all triangles, model units. Precondition: there is a
/// triangle.
inline double diagonal(const Shape& shape) {
  Eigen::Vector3d extents;
  for (int axis = 0; axis < 3; ++axis)
    extents[axis] = range_along(shape, Eigen::Vector3d::Unit(axis)).length();
  return extents.norm();
}

}  // namespace stackabilization::detail
