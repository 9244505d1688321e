#pragma once

#include <functional>
#include <vector>

#include "stackabilization/structure/segmentation.h"
#include "stackabilization/structure/symmetry_detection.h"

namespace stackabilization::detail {

/// Returns the symmetries of a shape as a whole.
using SymmetrySource = std::function<std::vector<FoundSymmetry>()>;

/// Does what `stackabilization::segment` does, for callers that know the symmetries of the whole shape or
/// need them later. Asks for them at most once, when a shape is cut.
Shape segment(const Shape& shape, const SegmentationOptions& options, const SymmetrySource& symmetries);

}  // namespace stackabilization::detail
