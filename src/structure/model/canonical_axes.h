#pragma once

#include <Eigen/Core>

/// Conventions from the axes of the file, for choices that a part leaves open: the sign of a direction, the
/// start of a loop, the rotation of a box about its axis.
namespace stackabilization::detail {

/// Returns `direction` or its opposite, such that it points towards +z, or towards +y when it is horizontal,
/// or towards +x when it is parallel to x.
Eigen::Vector3d canonical_sense(const Eigen::Vector3d& direction);

/// Returns the unit vector orthogonal to the unit vector `axis` that is nearest to a file axis: to the file
/// axis at the largest angle from `axis`, the first one of several.
Eigen::Vector3d orthogonal_axis(const Eigen::Vector3d& axis);

}  // namespace stackabilization::detail
