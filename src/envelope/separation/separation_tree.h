#pragma once

#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <vector>

#include "stackabilization/envelope/separation.h"

namespace stackabilization {

/// Corners of one triangle, relative to the origin of the tree, and its row in the shape.
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

/// Number of the diagonals of the faces of a cube: (1, 1, 0), (0, 1, 1), (1, 0, 1), (1, -1, 0), (0, 1, -1)
/// and (-1, 0, 1), in this order.
inline constexpr int diagonal_count = 6;

/// Computes d . p for one of the diagonals d, with one rounding. `p`: three coordinates.
inline double along_diagonal(const double* p, int diagonal) {
  const int i = diagonal % 3, j = (diagonal + 1) % 3;
  return diagonal < 3 ? p[i] + p[j] : p[i] - p[j];
}

/// Returns a number of single precision that is not above `value`, close to it.
inline float single_below(double value) {
  constexpr float most = std::numeric_limits<float>::max(), infinite = std::numeric_limits<float>::infinity();
  if (value >= most) return most;
  if (value < -most) return -infinite;
  const auto nearest = static_cast<float>(value);
  return nearest > value ? std::nextafter(nearest, -infinite) : nearest;
}

/// Returns a number of single precision that is not below `value`, close to it.
inline float single_above(double value) {
  return -single_below(-value);
}

/// Bounding volume of a node: an axis-aligned box with its edges cut off by the diagonals, and one slab,
/// slab_low <= normal . p <= slab_high. `normal` is zero when there is no slab. Leaves have count > 0.
/// Source: the 18-DOP of Klosowski et al. 1998, but for the slab.
struct TreeNode {
  std::array<double, 3> low, high;  ///< corners of the box, relative to the origin of the tree
  /// Bounds of d . p, rounded outwards to single precision: half the memory, and tight enough.
  std::array<float, diagonal_count> diagonal_low, diagonal_high;
  std::array<double, 3> normal;  ///< unit normal of the slab, or zero
  double slab_low, slab_high;    ///< bounds of normal . p, rounded outwards
  std::int32_t first;            ///< leaf: first triangle; inner: left child, the right one follows it
  std::int32_t count;            ///< leaf: number of triangles; inner: 0
};

/// Largest number of triangles in a leaf.
inline constexpr int leaf_size = 2;

/// Content of a SeparationTree.
struct SeparationTree::Data {
  /// Origin of the tree, subtracted from all coordinates without rounding. The error bounds of the filters
  /// grow with the coordinates; for a shape far from the file's origin they would exceed its features.
  std::array<double, 3> origin{};
  /// Triangles in tree order; of triangles with the same points, the first one.
  std::vector<TreeTriangle> triangles;
  std::vector<TriangleCopy> copies;  ///< the other triangles with the same points, sorted
  std::vector<TreeNode> nodes;       ///< nodes[0] is the root
  double magnitude = 0;              ///< largest absolute coordinate, relative to the origin

  /// Returns a triangle with the exact coordinates of the shape.
  TreeTriangle in_file_axes(std::int32_t triangle) const;
  /// Rebuilds the tree with the file's origin.
  Data in_file_axes() const;
};

}  // namespace stackabilization
