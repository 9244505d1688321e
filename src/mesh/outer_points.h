#pragma once

#include <Eigen/Core>
#include <vector>

#include "stackabilization/core/shape.h"

namespace stackabilization {

/// Returns the rows, ascending, of those points that may be corners of the convex hull: all but what lies
/// inside of the hull of some outermost ones, by more than rounding. Their hull is that of all points.
/// Precondition: coordinates as after scaled_by_power with working_exponent.
std::vector<Eigen::Index> outer_points(const Points& points);

}  // namespace stackabilization
