#pragma once

#include "stackabilization/deformation/deformation_model.h"

namespace stackabilization {

/// Converts the result of edits into a new shape at rest, for further edits or for a file. Its primitives are
/// those of `result`, with their rotations reset to the identity. Each joint point is the mean of the
/// positions to which its two parts carry it. Symmetries are those of `rest`, because edits keep them. Fits
/// and residuals of relations are those of `rest`, measured against its surface. Structure::diagonal is that
/// of the new shape.
///
/// Throws UsageError when the edits were refused or the model has no primitives. Precondition: `result` comes
/// from `rest`.
StructuredShape rebase(const StructuredShape& rest, const DeformationResult& result);

}  // namespace stackabilization
