#pragma once

#include <Eigen/Core>

#include "stackabilization/core/shape.h"

namespace stackabilization {

/// Affine span of a set of points: a point, a line, a plane or all of space.
struct AffineSpan {
  int dimension = 0;                                 ///< 0: one point, 1: straight, 2: flat, 3: solid
  Eigen::Vector3d origin = Eigen::Vector3d::Zero();  ///< a point of the set
  /// Unit vector along the line, or one in the plane; zero for dimensions 0 and 3.
  Eigen::Vector3d axis = Eigen::Vector3d::Zero();
  /// Unit normal of the plane, from dimension 2 on; else zero.
  Eigen::Vector3d normal = Eigen::Vector3d::Zero();
};

/// Computes the affine span up to a resolution. In dimension d, all points lie within `resolution` (model
/// units, >= 0) of a flat of dimension d through the most distant of them. The dimension is at most
/// `affine_dimension`: a set that is solid here is solid to exact predicates. A resolution of 0 gives that
/// dimension up to rounding. Precondition: at least one point, all finite.
AffineSpan affine_span(const Points& points, double resolution);

/// Computes the exact dimension of the affine span, 0 to 3. Precondition: at least one point, all finite.
int affine_dimension(const Points& points);

/// Computes an exponent e for scaling. After multiplication of the coordinates by 2^e, their squares, cubes
/// and products of a few of them do not overflow, and no relevant one underflows. The exponent is 0 unless
/// the largest coordinate is above 1e60 or below 1e-60; then 2^e scales it to between 1/2 and 1.
int working_exponent(const Points& points);

/// Returns the points multiplied by 2^exponent. Exact, unless a coordinate underflows.
Points scaled_by_power(const Points& points, int exponent);

}  // namespace stackabilization
