#pragma once

#include <cstdint>

#include "stackabilization/improvement/rest_shape.h"

namespace stackabilization {

/// Returns the largest number of designs that `effort` makes and measures for `rest`; infinite for an
/// infinite effort.
///
/// Effort counts work, not time, so equal input has equal results on every machine. Effort 1 takes up to
/// about 40 seconds on two cores; the work is proportional to the effort. The number of designs falls with
/// the number of triangles, of parts and of corners of the convex hull, since designs of such shapes take
/// longer. Throws UsageError unless the effort is above 0.
double designs_of_effort(double effort, const RestShape& rest);

/// Returns the largest number of directions along which S of `shape` is measured when the whole effort goes
/// into that, >= 1. Throws UsageError unless the effort is above 0.
std::int64_t directions_of_effort(double effort, const Shape& shape);

}  // namespace stackabilization
