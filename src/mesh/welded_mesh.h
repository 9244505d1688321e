#pragma once

#include <cstdint>
#include <vector>

#include "stackabilization/core/shape.h"

namespace stackabilization::detail {

/// The triangles of a shape after welding: vertices of equal coordinates (-0 = 0) are one vertex. Many
/// formats repeat vertices, so only coordinates identify neighbours.
struct WeldedMesh {
  Points points;        ///< k x 3, model units, in order of first use by the triangles
  Triangles triangles;  ///< m x 3 rows of `points`; row t is triangle t of the shape
  /// Row of `points` for each vertex of the shape; -1 for a vertex that no triangle uses. When parts are
  /// welded separately, a shared vertex has the row of the last part that uses it.
  std::vector<std::int32_t> of_vertex;
  /// Per row of `points`, the first vertex of the shape at this point that a triangle uses.
  std::vector<std::int32_t> first_vertex;

  /// Returns whether two corners of the triangle are one vertex.
  bool has_equal_corners(Eigen::Index triangle) const;
  /// Computes the area of the triangle, model units squared.
  double area(Eigen::Index triangle) const;
  /// Returns for every triangle the first one with the same corners, in any order: itself, unless it is a
  /// copy.
  std::vector<std::int32_t> first_copies() const;
};

/// Scope of welding: all vertices of equal coordinates, or only those of triangles of the same part.
enum class Weld { all, within_parts };

/// Welds the vertices of a shape; expected O(m). Precondition: `validate(shape)`.
WeldedMesh weld(const Shape& shape, Weld which = Weld::all);

/// Returns the component of every triangle. Components are connected through common vertices and numbered 0,
/// 1, ... in the order of their first triangles.
std::vector<std::int32_t> connected_components(const WeldedMesh& mesh);

}  // namespace stackabilization::detail
