#pragma once

#include <Eigen/Core>

#include "stackabilization/core/shape.h"

/// Not installed.
namespace stackabilization::detail {

struct MassCentre {
  Eigen::Vector3d centre = Eigen::Vector3d::Zero();  ///< model units
  bool of_solid = false;                             ///< else of a shell of even thickness
};

/// Centre of mass of the solid that a closed surface encloses, else of its area. Every component of a closed
/// surface is a body, whichever way it is turned, unless it lies in the box of a larger one and is turned
/// against it: that is a cavity. Where bodies overlap the mass counts twice. A closed surface that encloses
/// next to nothing, such as a sheet with two sides, counts by its area. Throws InputError when there is no
/// area. Precondition: `validate(shape)`.
MassCentre mass_centre(const Shape& shape);

}  // namespace stackabilization::detail
