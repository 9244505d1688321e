#pragma once

#include <cstdint>

#include "stackabilization/structure/structure.h"

namespace stackabilization {

/// The work of a run is counted, not timed, so that the same input has the same result on every machine. An
/// effort of 1 is work that takes about 40 seconds on two cores of 2 GHz, typically less, since a run ends when
/// nothing is left to do; other efforts are multiples. Efforts must be above 0 and may be infinite.

/// Designs of a shape that an effort makes and measures at most: fewer of a shape with more triangles and
/// parts, each of which takes longer. Throws UsageError for an effort that is not above 0.
double designs_of_effort(double effort, const StructuredShape& rest);

/// Directions along which S of a shape is measured at most, when all of an effort goes into that, >= 1. Throws
/// UsageError for an effort that is not above 0.
std::int64_t directions_of_effort(double effort, const Shape& shape);

}  // namespace stackabilization
