#pragma once

#include <Eigen/Core>

#include "stackabilization/core/shape.h"

namespace stackabilization {

/// The smallest flat that holds a set of points: a point, a line, a plane or all of space.
struct AffineSpan {
  int dimension = 0;                                 ///< 0: one point, 1: straight, 2: flat, 3: solid
  Eigen::Vector3d origin = Eigen::Vector3d::Zero();  ///< a point of the set
  Eigen::Vector3d axis = Eigen::Vector3d::Zero();    ///< unit; along the line, or in the plane; else zero
  Eigen::Vector3d normal = Eigen::Vector3d::Zero();  ///< unit; across the plane, from dimension 2 on
};

/// Decides whether points are solid, flat, straight or one, up to a resolution: dimension d holds all points
/// within `resolution` (model units, >= 0) of a flat of that dimension through the most distant of them.
/// Never more than `affine_dimension`, so points that are solid here are solid to exact predicates; a
/// resolution of 0 gives that dimension up to rounding. Precondition: at least one point, all finite.
AffineSpan affine_span(const Points& points, double resolution);

/// The exact dimension of the smallest flat that holds the points, 0 to 3. Same precondition.
int affine_dimension(const Points& points);

/// The exponent e for which no square or cube of the points' coordinates times 2^e, and no product of a few
/// of them, overflows, and none that matters underflows. 0 unless the largest coordinate is beyond 1e60 or
/// below 1e-60; then 2^e brings it to between 1/2 and 1.
int working_exponent(const Points& points);

/// The points with all coordinates times 2^exponent: exact, unless a coordinate underflows.
Points scaled_by_power(const Points& points, int exponent);

}  // namespace stackabilization
