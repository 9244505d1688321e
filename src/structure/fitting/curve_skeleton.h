#pragma once

#include <array>
#include <optional>
#include <vector>

#include "stackabilization/core/shape.h"

namespace stackabilization::detail {

/// A polyline; a closed one goes from its last point back to the first.
struct Curve {
  Points points;
  bool closed = false;
};

/// A curve skeleton: points and the pairs of them that are joined.
struct Skeleton {
  Points points;
  std::vector<std::array<int, 2>> edges;
};

/// Mean curvature flow skeleton (Tagliasacchi, Alhashim, Olson, Zhang: Mean curvature skeletons, SGP 2012) of
/// a closed, connected, outward oriented surface of even triangles. Nothing when it collapses to a point or
/// fails.
std::optional<Skeleton> curve_skeleton(const Shape& closed_surface);

/// What of a skeleton a generalized cylinder follows: its loop, when it has one that makes up half of its
/// length; else the longest of the shortest paths in it, from its lower end (by z, y, x). Nothing for a
/// skeleton without edges, or one of which that path leaves out more than 15 %: a rack of bars is no tube.
std::optional<Curve> main_curve(const Skeleton& skeleton);

}  // namespace stackabilization::detail
