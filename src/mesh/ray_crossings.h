#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <cstdint>
#include <utility>
#include <vector>

#include "mesh/surface_moments.h"
#include "mesh/triangle_tree.h"

namespace stackabilization::detail {

/// A triangle that a segment crosses.
struct Crossing {
  double distance;        ///< distance of the triangle's plane from the start of the segment, model units
  std::int32_t triangle;  ///< row of Shape::triangles

  /// Orders by distance, then by triangle.
  bool operator<(const Crossing& other) const {
    return std::pair(distance, triangle) < std::pair(other.distance, other.triangle);
  }
};

/// Returns the triangles of `tree` that the segment of `length` from `start` along the unit vector `along`
/// crosses, nearest first. `shape`: the shape of the tree. Triangles nearer than `least` are left out.
template <class Kernel>
std::vector<Crossing> crossings(const TriangleTree<Kernel>& tree, const Shape& shape,
                                const Eigen::Vector3d& start, const Eigen::Vector3d& along, double least,
                                double length) {
  std::vector<std::size_t> met;
  tree.append_met(typename Kernel::Segment_3(to_cgal<Kernel>(start), to_cgal<Kernel>(start + length * along)),
                  met);
  std::vector<Crossing> found;
  for (const std::size_t entry : met) {
    const std::int32_t t = tree.rows()[entry];
    const Eigen::Vector3d normal = unit_normal(shape, t);
    const double distance = normal.dot(shape.corner(t, 0) - start) / normal.dot(along);
    if (distance > least && distance <= length) found.push_back({distance, t});
  }
  std::sort(found.begin(), found.end());
  return found;
}

/// Keeps one of the crossings at a common edge or corner: of successive ones within `reach`, the first.
inline void merge_at_edges(std::vector<Crossing>& sorted, double reach) {
  const auto same = [&](const Crossing& a, const Crossing& b) { return b.distance - a.distance <= reach; };
  sorted.erase(std::unique(sorted.begin(), sorted.end(), same), sorted.end());
}

}  // namespace stackabilization::detail
