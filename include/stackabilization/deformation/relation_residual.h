#pragma once

#include <vector>

#include "stackabilization/structure/structure.h"

namespace stackabilization {

/// How far each relation of `rest` is from holding between primitives that were deformed, fraction of
/// Structure::diagonal:
///
/// * symmetry, self_symmetry: largest distance between a control point's image and its counterpart, and
/// largest
///   difference of radii;
/// * joints: largest distance between where the two primitives carry a joint point to (transfer.h).
///
/// Recomputed from the primitives alone: the independent check of what a solver reports. Precondition: one
/// primitive per part, of the same kinds and sizes as in `rest`.
std::vector<double> relation_residuals(const Structure& rest, const std::vector<Primitive>& deformed);

}  // namespace stackabilization
