#pragma once

#include <Eigen/Core>
#include <string>

namespace stackabilization {

/// Returns a direction of any length as text for people: "along z", "along -x", "along (0.123, 0, 0.992)". A
/// direction within a millionth of an axis has the name of the axis. Any other direction is written as a unit
/// vector with three digits after the point, or with more digits when three would look like an axis.
std::string direction_text(const Eigen::Vector3d& direction);

}  // namespace stackabilization
