#pragma once

#include <cstddef>
#include <memory>
#include <optional>

#include "stackabilization/core/direction.h"
#include "stackabilization/deformation/deformation_model.h"

namespace stackabilization {

/// Limits on the size of a shape that `deformation_model` accepts. By default those of a search, which makes
/// hundreds of edits and compares all pairs of parts with each energy.
struct DeformationLimits {
  std::size_t max_parts = 500;         ///< largest number of parts
  std::size_t max_joint_points = 200;  ///< see ControllerLimits
};

/// Which deformation model `deformation_model` prepares.
struct DeformationModelOptions {
  DeformationKind kind = DeformationKind::controllers;  ///< the model
  /// Direction along which gap scaling compresses (default: z), and main axis of the slices of the surface
  /// model (default: SurfaceModelOptions::axis).
  std::optional<Direction> direction = {};
  DeformationLimits limits = {};          ///< size of the shape
  Following following = Following::free;  ///< controllers: how parts follow an edit
};

/// Prepares a deformation model for `rest`. iWires keep the symmetries of the structure. Throws as the
/// constructor of the model and as `validate`. Throws InputError for a shape beyond the limits.
std::unique_ptr<DeformationModel> deformation_model(StructuredShape rest,
                                                    const DeformationModelOptions& options = {});

}  // namespace stackabilization
