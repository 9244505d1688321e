#pragma once

#include <Eigen/Core>
#include <string>

namespace stackabilization {

/// For people, whatever its length: "along z", "along -x", "along (0.123, 0, 0.992)". An axis is named where
/// the direction is within a millionth of it; otherwise the unit vector has three digits after the point, and
/// more where these would look like an axis.
std::string direction_text(const Eigen::Vector3d& direction);

}  // namespace stackabilization
