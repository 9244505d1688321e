#pragma once

#include <Eigen/Geometry>

#include "stackabilization/core/shape.h"

namespace stackabilization::detail {

/// Applies `map` to every row: one product, then one sum per coordinate.
template <int Mode>
Points transformed(const Points& points, const Eigen::Transform<double, 3, Mode>& map) {
  return (points * map.linear().transpose()).rowwise() + map.translation().transpose();
}

}  // namespace stackabilization::detail
