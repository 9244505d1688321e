#pragma once

#include <Eigen/Core>

#include "stackabilization/core/direction.h"
#include "stackabilization/core/shape.h"
#include "stackabilization/stacking/place.h"

namespace stackabilization::detail {

/// Two shapes in the frame of r: coordinates along u, v and w = r / |r|, rounded. Along +z they are the
/// file's.
struct LocalShapes {
  Shape base;                                        ///< not moved
  Shape shape;                                       ///< its given place is the origin of x and y
  Eigen::Vector2d centre = Eigen::Vector2d::Zero();  ///< given place of the shape
  double size = 0;                                   ///< largest coordinate of both, wherever they meet

  LocalShapes(const Shape& base, const Shape& shape, const Direction& direction);
};

/// Returns the box of a shape across the third axis: smallest and largest x, then y.
struct Outline {
  Eigen::Vector2d low, high;

  explicit Outline(const Shape& local);
  Eigen::Vector2d centre() const { return low / 2 + high / 2; }
};

}  // namespace stackabilization::detail
