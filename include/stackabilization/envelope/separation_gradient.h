#pragma once

#include <Eigen/Core>

#include "stackabilization/core/direction.h"
#include "stackabilization/core/shape.h"
#include "stackabilization/envelope/separation.h"

namespace stackabilization {

/// A subgradient of the length of a separation, model units per model unit.
struct SeparationGradient {
  Eigen::Matrix3d upper;      ///< row i: by corner i of Witness::upper_triangle, of the shape below
  Eigen::Matrix3d lower;      ///< row i: by corner i of Witness::lower_triangle, of the shape above
  Eigen::Vector3d direction;  ///< by the direction r, whose length does not change the separation's
};

/// Computes a subgradient of sep(below, above, r) |r| by the corners of the two triangles of its witness and
/// by r. By all other vertices it is 0. When the two shapes are one, the gradient by a vertex is the sum over
/// the corners that it is. Away from kinks, where another pair of triangles or of edges attains the same
/// value, it is the gradient; at a kink it is that of one of the pairs.
///
/// The separation is the optimum of a linear programme over the points of the two triangles. Its gradient is
/// the multiplier n of the common line, n.r = 1, which is the normal of the plane between the triangles where
/// they touch, times the barycentric weights of the two points. Double precision.
///
/// `separation`: result of `separation` for these shapes and this direction. Throws UsageError when it is not
/// blocked, or one of the triangles is degenerate.
SeparationGradient separation_gradient(const Shape& below, const Shape& above, const Direction& direction,
                                       const Separation& separation);

}  // namespace stackabilization
