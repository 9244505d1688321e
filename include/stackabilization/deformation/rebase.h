#pragma once

#include "stackabilization/deformation/design.h"
#include "stackabilization/structure/structure.h"

namespace stackabilization {

/// Converts a design into a new shape at rest, for further edits or for a file. Its primitives are those of
/// `design`, with their rotations reset to the identity. Each joint point is the mean of the
/// positions to which its two parts carry it. Symmetries are those of `rest`, because edits keep them. Fits
/// and residuals of relations are those of `rest`, measured against its surface. Structure::diagonal is that
/// of the new shape.
///
/// Throws UsageError when the design has no primitives. Precondition: `design` was made of `rest` by a model
/// that edits primitives.
StructuredShape rebase(const StructuredShape& rest, const Design& design);

}  // namespace stackabilization
