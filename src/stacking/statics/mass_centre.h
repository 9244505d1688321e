#pragma once

#include <Eigen/Core>

#include "stackabilization/core/shape.h"

namespace stackabilization::detail {

/// Centre of mass of a shape.
struct MassCentre {
  Eigen::Vector3d centre = Eigen::Vector3d::Zero();  ///< model units
  /// Whether the mass is that of the enclosed solid; otherwise that of a shell of uniform thickness.
  bool of_solid = false;
};

/// Computes the centre of mass of the solid that a closed surface encloses, otherwise that of the surface.
/// Every component of a closed surface is a body, whatever its orientation. A component inside the box of a
/// larger one and of opposite orientation is a cavity. Where bodies overlap, the mass counts twice. A closed
/// surface with negligible volume, such as a two-sided sheet, counts by its area. Throws InputError when
/// there is no area. Precondition: `validate(shape)`.
MassCentre mass_centre(const Shape& shape);

}  // namespace stackabilization::detail
