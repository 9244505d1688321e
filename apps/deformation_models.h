#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include "apps/deform_run.h"
#include "stackabilization/deformation/deformation_model.h"

namespace stackabilization::apps {

/// The model that `options` ask for, for a shape at rest. Throws as its constructor does.
std::unique_ptr<DeformationModel> make_deformation_model(const DeformCommandOptions& options,
                                                         const StructuredShape& rest);

/// Vertices along the feature curves that `edits` take hold of, for pictures; none for models without such
/// curves.
std::vector<std::vector<std::int32_t>> edited_curves(const DeformationModel& model,
                                                     const std::vector<Edit>& edits);

}  // namespace stackabilization::apps
