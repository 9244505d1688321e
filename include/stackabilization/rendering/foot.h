#pragma once

#include <Eigen/Core>

#include "stackabilization/core/direction.h"
#include "stackabilization/core/shape.h"

namespace stackabilization {

/// The point on the ground below the middle of the box of a shape in the frame of r.
Eigen::Vector3d foot_of(const Shape& shape, const Direction& direction);

/// The shape moved so that its foot is the origin.
Shape on_ground(const Shape& shape, const Direction& direction);

}  // namespace stackabilization
