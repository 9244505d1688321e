#pragma once

#include <Eigen/Core>
#include <limits>

#include "envelope/contacts/planar_union.h"

namespace stackabilization::detail {

/// Axis-parallel rectangle around outlines; inverted while it is empty.
struct OutlineBounds {
  Eigen::Vector2d low = Eigen::Vector2d::Constant(std::numeric_limits<double>::infinity());
  Eigen::Vector2d high = -low;

  void add(const ConvexPolygon& outline) {
    for (const Eigen::Vector2d& p : outline) {
      low = low.cwiseMin(p);
      high = high.cwiseMax(p);
    }
  }
};

}  // namespace stackabilization::detail
