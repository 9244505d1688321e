#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "stackabilization/core/shape.h"

namespace stackabilization::detail {

/// One side of a triangle, between two of its vertices.
struct TriangleSide {
  std::int32_t low, high;  ///< the edge's vertices, low < high
  std::int32_t triangle;   ///< row of the triangle matrix
  std::int32_t corner;     ///< the side goes from this corner to the next one
  bool forward;            ///< from `low` to `high`
};

/// The edges of a triangle mesh with the triangles beside each: any number of them, turned either way. Edges
/// are ordered by their vertices, the sides of one edge by triangle and corner.
class EdgeTable {
 public:
  /// What happens to triangles that have a vertex twice.
  enum class Collapsed {
    skip,  ///< they have no sides
    keep   ///< they have those sides whose ends differ
  };

  /// Sorts the sides of all triangles; O(m log m). Rows hold non-negative numbers of vertices.
  explicit EdgeTable(const Eigen::Ref<const Triangles>& triangles, Collapsed collapsed = Collapsed::skip);

  /// Number of edges.
  std::size_t size() const { return first_.size() - 1; }
  /// Gives the sides along one edge, at least one.
  std::span<const TriangleSide> operator[](std::size_t edge) const {
    return std::span(sides_).subspan(first_[edge], first_[edge + 1] - first_[edge]);
  }
  /// Gives the sides of all edges in order.
  const std::vector<TriangleSide>& sides() const { return sides_; }

 private:
  std::vector<TriangleSide> sides_;
  std::vector<std::size_t> first_;  ///< per edge its first side, then their number
};

}  // namespace stackabilization::detail
