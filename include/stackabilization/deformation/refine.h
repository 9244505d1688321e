#pragma once

#include <cstdint>

#include "stackabilization/core/shape.h"

namespace stackabilization {

/// Limits of `refine`.
struct RefineOptions {
  double max_edge_length = 0.02;  ///< largest length of an edge, fraction of the bounding-box diagonal; > 0
  std::int64_t max_triangles = 1'000'000;  ///< largest number of triangles of the result
};

/// Bisects every edge longer than the limit until none is left. A midpoint splits the edge in both of its
/// triangles. Existing vertices keep their rows, and parts keep their names. Children follow their parent
/// triangle in order. Equal edges have equal midpoints. The surface does not change. Deterministic.
///
/// The function prepares shapes with large triangles for models that move only vertices. Throws InputError
/// when `shape` is invalid, and UsageError for options out of range and when the limit needs more triangles
/// than `max_triangles`.
Shape refine(const Shape& shape, const RefineOptions& options = {});

}  // namespace stackabilization
