#pragma once

#include <Eigen/Core>

#include "stackabilization/core/shape.h"

namespace stackabilization::detail {

/// Computes the barycentric weights of the point of the triangle's plane that is nearest to `point`, by least
/// squares with QR. The weights sum to one. For points of the triangle they lie in [0, 1] up to rounding.
/// Precondition: the triangle has a positive area.
Eigen::Vector3d barycentric_weights(const Shape& shape, Eigen::Index triangle, const Eigen::Vector3d& point);

/// The same for a triangle with these corners in rows.
Eigen::Vector3d barycentric_weights(const Eigen::Matrix3d& corners, const Eigen::Vector3d& point);

/// Returns the point with the given weights, model units.
Eigen::Vector3d point_at(const Shape& shape, Eigen::Index triangle, const Eigen::Vector3d& weights);

}  // namespace stackabilization::detail
