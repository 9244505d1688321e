#pragma once

#include <cstdint>
#include <vector>

#include "stackabilization/core/shape.h"

namespace stackabilization::detail {

/// Conditions for merging two components into one part.
struct ContactRule {
  /// Largest distance between touching surfaces, fraction of the diagonal of the bounding box of the shape.
  double reach = 0.002;
  /// Smallest share of the area of the smaller component that is flush with the larger one.
  double shared_area =
      1.0 / 3;  ///< of the smaller one's area, flush with the larger one, from which on they are one part
  /// Largest area of a screw, plug or cap, fraction of the area of the larger component.
  double tiny = 0.02;
  /// Smallest share of the area of a screw, plug or cap inside the convex hull of the larger component.
  double inside = 0.5;
};

/// Returns the part of every triangle. Parts are the components connected through common points, after two
/// kinds of merges. Two components merge when they are flush over `shared_area` of the smaller one. A
/// component also merges into a larger one when it is a screw, plug or cap of it: it touches the larger one,
/// its area is at most `tiny`, and a share `inside` of it lies in the convex hull of the larger one. The end
/// of a leg is a small share of the leg, so legs stay separate. Parts are numbered in the order of their
/// first triangles. Components without area join the nearest part.
std::vector<std::int32_t> merged_components(const Shape& shape, const ContactRule& rule = {});

}  // namespace stackabilization::detail
