#pragma once

#include <cstdint>
#include <vector>

#include "stackabilization/core/shape.h"

/// Not installed.
namespace stackabilization::detail {

/// When two components are one part.
struct ContactRule {
  double reach = 0.002;  ///< surfaces this near touch, fraction of the bounding-box diagonal of the shape
  double shared_area =
      1.0 / 3;  ///< of the smaller one's area, flush with the larger one, from which on they are one part
  double tiny = 0.02;   ///< of the larger one's area: at most this, ...
  double inside = 0.5;  ///< ... with this share of it inside the larger one's convex hull, and touching it
};

/// Number of the part per triangle: components through common points, merged where two of them are flush over
/// much of the smaller one, or the smaller one is a screw, plug or cap of the larger one. The end of a leg is
/// a small share of the leg: it stays. Numbered in order of first triangles; triangles of components without
/// area go to the nearest.
std::vector<std::int32_t> merged_components(const Shape& shape, const ContactRule& rule = {});

}  // namespace stackabilization::detail
