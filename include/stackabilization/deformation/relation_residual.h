#pragma once

#include <vector>

#include "stackabilization/structure/structure.h"

namespace stackabilization {

/// Computes the residual of each relation of `rest` between deformed primitives, fraction of
/// Structure::diagonal; one number per row of Structure::relations:
///
/// * symmetry, self_symmetry: the largest distance between the image of a control point and its counterpart,
///   or the largest difference of radii if that is greater;
/// * joints: the largest distance between the positions to which the two primitives carry a joint point
///   (transfer.h); of a joint that may slide, only its part in the directions in which it is held.
///
/// The function uses the primitives alone and so checks the residuals of a solver independently.
/// Precondition: one primitive per part, of the same kinds and sizes as in `rest`. Throws InputError when
/// symmetric primitives of `rest` differ in kind or in their number of cross-sections.
std::vector<double> relation_residuals(const Structure& rest, const std::vector<Primitive>& deformed);

}  // namespace stackabilization
