#pragma once

#include <Eigen/Core>

/// What a part leaves open, the axes of the file decide: the sense of a direction, the start of a loop, the
/// turn of a box about its pole.
namespace stackabilization::detail {

/// `direction` or its opposite: toward z; when horizontal toward y, else x.
Eigen::Vector3d canonical_sense(const Eigen::Vector3d& direction);

/// Unit vector orthogonal to the unit vector `axis`, nearest to the file axis that stands most upright on it;
/// of several the first.
Eigen::Vector3d orthogonal_axis(const Eigen::Vector3d& axis);

}  // namespace stackabilization::detail
