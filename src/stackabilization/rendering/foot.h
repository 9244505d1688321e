#pragma once

#include <Eigen/Core>

#include "stackabilization/shape/direction.h"
#include "stackabilization/shape/shape.h"

namespace stackabilization::detail {

/// The point on the ground below the middle of the box of a shape in the frame of r: what is moved by minus
/// this stands at the origin. Private to rendering/.
Eigen::Vector3d foot_of(const Shape& shape, const Direction& direction);

}  // namespace stackabilization::detail
