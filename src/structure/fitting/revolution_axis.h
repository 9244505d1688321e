#pragma once

#include <Eigen/Core>
#include <optional>

#include "structure/model/fit_error.h"

namespace stackabilization::detail {

/// A line.
struct AxisLine {
  Eigen::Vector3d point;
  Eigen::Vector3d direction;  ///< unit
};

/// The axis of a body of revolution, hollow or not: the line that the normals of the surface meet best, by
/// least squares in line coordinates (Pottmann and Randrup, Rotational and helical surface approximation,
/// Computing 60, 1998), integrated over the triangles, so that it does not depend on how they are oriented or
/// sampled. Nothing when the part, turned about it by several angles, misses itself by more than a regular
/// octagon would.
std::optional<AxisLine> revolution_axis(const FitSurface& part);

}  // namespace stackabilization::detail
