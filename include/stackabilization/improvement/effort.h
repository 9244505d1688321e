#pragma once

#include <cstdint>

#include "stackabilization/structure/structure.h"

namespace stackabilization {

/// How many designs of a shape an effort makes and measures at most.
///
/// Work is counted, not timed, so that the same input has the same result on every machine. An effort of 1 is
/// work that takes up to about 40 seconds on two cores of 2 GHz; others are multiples of it, and may be
/// infinite. A design of a shape with more triangles, parts and corners of its convex hull takes longer, so
/// that fewer are made. Throws UsageError for an effort that is not above 0.
double designs_of_effort(double effort, const StructuredShape& rest);

/// Along how many directions S of a shape is measured at most when all of an effort goes into that, >= 1.
/// Throws UsageError for an effort that is not above 0.
std::int64_t directions_of_effort(double effort, const Shape& shape);

}  // namespace stackabilization
