#pragma once

#include <Eigen/Core>

#include "stackabilization/core/shape.h"

namespace stackabilization::detail {

/// Gives the weights, summing to one, of the corners of a triangle in the point of its plane that is nearest
/// to `point`: least squares by QR. On the triangle they lie within [0, 1] up to rounding. Precondition: the
/// triangle has area.
Eigen::Vector3d barycentric_weights(const Shape& shape, Eigen::Index triangle, const Eigen::Vector3d& point);

/// The point with these weights.
Eigen::Vector3d point_at(const Shape& shape, Eigen::Index triangle, const Eigen::Vector3d& weights);

}  // namespace stackabilization::detail
