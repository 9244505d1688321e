#pragma once

#include "stackabilization/deformation/deformation_model.h"

namespace stackabilization {

/// The result of edits as a new shape at rest, to be edited further or saved. Its primitives are those of
/// `result`, their turns forgotten; joints lie where their parts carry them (the mean of both); symmetries
/// stay, since edits keep them; fits and residuals of relations are those of the old rest, against the
/// surface.
///
/// Throws UsageError when the edits were refused or the model has no primitives. Precondition: `result` comes
/// from `rest`.
StructuredShape settled(const StructuredShape& rest, const DeformationResult& result);

}  // namespace stackabilization
