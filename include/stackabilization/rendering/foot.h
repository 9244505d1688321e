#pragma once

#include <Eigen/Core>

#include "stackabilization/core/direction.h"
#include "stackabilization/core/shape.h"

namespace stackabilization {

/// Returns the point on the ground below the centre of the box of a shape, in the frame of r.
Eigen::Vector3d foot_of(const Shape& shape, const Direction& direction);

/// Returns the shape, moved such that its foot is the origin.
Shape on_ground(const Shape& shape, const Direction& direction);

}  // namespace stackabilization
