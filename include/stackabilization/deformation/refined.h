#pragma once

#include <cstdint>

#include "stackabilization/core/shape.h"

namespace stackabilization {

/// How finely `refined` cuts.
struct RefineOptions {
  double longest_edge = 0.02;               ///< fraction of the bounding-box diagonal; > 0
  std::int64_t most_triangles = 1'000'000;  ///< more are refused
};

/// The same surface with triangles none of whose edges is longer than allowed: edges that are get a vertex in
/// their middle, in both of their triangles, again and again. Old vertices keep their rows, parts their
/// names; a triangle is followed by what it was cut off. Equal edges are cut in equal points. Deterministic.
///
/// For models that move vertices only, and shapes whose triangles are too large for that. Throws InputError
/// when `shape` is invalid, UsageError for options out of their ranges and where more triangles would be
/// needed than allowed.
Shape refined(const Shape& shape, const RefineOptions& options = {});

}  // namespace stackabilization
