#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "stackabilization/core/shape.h"

namespace stackabilization::detail {

/// A directed side of a triangle.
struct TriangleSide {
  std::int32_t low, high;  ///< vertices of the edge, low < high
  std::int32_t triangle;   ///< row of the triangle matrix
  std::int32_t corner;     ///< first corner of the side; the side ends at the next corner
  bool forward;            ///< whether the side runs from `low` to `high`
};

/// Edges of a triangle mesh with their adjacent triangles. An edge may have any number of triangles, of
/// either orientation. Edges are ordered by their vertices; the sides of one edge are ordered by triangle and
/// corner.
class EdgeTable {
 public:
  /// Treatment of triangles with two equal vertices.
  enum class Collapsed {
    skip,  ///< they contribute no sides
    keep   ///< they contribute the sides with different ends
  };

  /// Sorts the sides of all triangles; linear in these and in the largest vertex index, where each vertex has
  /// few triangles. Precondition: vertex indices are not negative.
  explicit EdgeTable(const Eigen::Ref<const Triangles>& triangles, Collapsed collapsed = Collapsed::skip);

  /// Returns the number of edges.
  std::size_t size() const { return first_.size() - 1; }
  /// Returns the sides along one edge, at least one.
  std::span<const TriangleSide> operator[](std::size_t edge) const {
    return std::span(sides_).subspan(first_[edge], first_[edge + 1] - first_[edge]);
  }
  /// Returns the sides of all edges, edge by edge.
  const std::vector<TriangleSide>& sides() const { return sides_; }

 private:
  void sort_sides(std::int32_t vertices);

  std::vector<TriangleSide> sides_;
  std::vector<std::size_t> first_;  ///< per edge, the row of its first side; then the number of sides
};

}  // namespace stackabilization::detail
