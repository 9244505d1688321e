#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "stackabilization/envelope/separation.h"

namespace stackabilization {

/// Corners of one triangle, relative to the origin of the tree, and where it came from.
struct TreeTriangle {
  std::array<std::array<double, 3>, 3> corners;  ///< by corner, then coordinate; model units
  std::int32_t index;                            ///< row of Shape::triangles
};

/// A triangle with the same three points as an earlier one.
struct TriangleCopy {
  std::int32_t first;  ///< row of Shape::triangles of the first triangle with these points
  std::int32_t copy;   ///< row of Shape::triangles of the later one

  /// Orders by the first triangle, then by the copy.
  friend bool operator<(const TriangleCopy& a, const TriangleCopy& b) {
    return a.first != b.first ? a.first < b.first : a.copy < b.copy;
  }
};

/// Axis-aligned box plus one slab  slab_low <= normal . p <= slab_high  holding all points of the node.
/// `normal` is zero where no slab is kept. Leaves have count > 0.
struct TreeNode {
  std::array<double, 3> low, high;  ///< corners of the box, relative to the origin of the tree
  std::array<double, 3> normal;     ///< of the slab; unit, or zero
  double slab_low, slab_high;       ///< bounds of normal . p, rounded outwards
  std::int32_t first;               ///< leaf: first triangle; inner: left child, the right one follows it
  std::int32_t count;               ///< leaf: number of triangles; inner: 0
};

/// Most triangles in a leaf.
inline constexpr int leaf_size = 2;

/// What a SeparationTree keeps.
struct SeparationTree::Data {
  /// Subtracted from all coordinates without rounding any: where a shape lies far from the file's origin, the
  /// error bounds of the filters, which grow with the coordinates, would drown its features.
  std::array<double, 3> origin{};
  std::vector<TreeTriangle> triangles;  ///< in tree order, of those with the same points the first
  std::vector<TriangleCopy> copies;     ///< the others, sorted
  std::vector<TreeNode> nodes;          ///< nodes[0] is the root
  double magnitude = 0;                 ///< largest absolute coordinate, relative to the origin

  /// The triangle as in the shape, exactly.
  TreeTriangle in_file_axes(std::int32_t triangle) const;
  /// The same shape with the file's origin, built again.
  Data in_file_axes() const;
};

}  // namespace stackabilization
