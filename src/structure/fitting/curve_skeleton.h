#pragma once

#include <array>
#include <optional>
#include <vector>

#include "stackabilization/core/shape.h"

namespace stackabilization::detail {

/// A polyline. In a closed one the first point follows the last.
struct Curve {
  Points points;
  bool closed = false;
};

/// A curve skeleton: points, and the pairs of points that are joined.
struct Skeleton {
  Points points;
  std::vector<std::array<int, 2>> edges;
};

/// Computes the mean curvature flow skeleton (Tagliasacchi, Alhashim, Olson, Zhang: Mean curvature skeletons,
/// SGP 2012). Returns nothing when the skeleton collapses to a point or CGAL fails. Precondition: the surface
/// is closed, connected and oriented outward, with well-shaped triangles.
std::optional<Skeleton> curve_skeleton(const Shape& closed_surface);

/// Returns the curve of a skeleton that a generalized cylinder follows. It is the loop, when the skeleton has
/// one with at least half of its length. Otherwise it is the longest of all shortest paths, from its lower
/// end (by z, y, x). Returns nothing for a skeleton without edges, and when that path omits more than 15 % of
/// the length: a rack of bars is not a tube.
std::optional<Curve> main_curve(const Skeleton& skeleton);

}  // namespace stackabilization::detail
