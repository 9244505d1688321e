#pragma once

#include <cstdint>
#include <vector>

#include "stackabilization/core/shape.h"

namespace stackabilization::detail {

/// The triangles of a shape whose vertices of equal coordinates (-0 = 0) are one. Formats repeat vertices, so
/// that neighbours are known by their coordinates only.
struct WeldedMesh {
  Points points;        ///< k x 3, model units, in order of first use by the triangles
  Triangles triangles;  ///< m x 3 rows of `points`; row t is triangle t of the shape
  /// Per vertex of the shape its row of `points`, of the last part that uses it where points of parts differ;
  /// -1 where no triangle uses it.
  std::vector<std::int32_t> of_vertex;
  std::vector<std::int32_t> first_vertex;  ///< per row of `points` the first vertex that triangles use there

  /// Whether two corners of the triangle are one vertex.
  bool has_equal_corners(Eigen::Index triangle) const;
  /// Area of the triangle, model units squared.
  double area(Eigen::Index triangle) const;
};

/// Which vertices of equal coordinates become one: all, or those of triangles of the same part.
enum class Weld { all, within_parts };

/// Welds the vertices of a shape; expected O(m). Precondition: `validate(shape)`.
WeldedMesh weld(const Shape& shape, Weld which = Weld::all);

/// Numbers the components that hang together by common vertices 0, 1, ... in order of their first triangles,
/// and gives the number of every triangle.
std::vector<std::int32_t> connected_components(const WeldedMesh& mesh);

}  // namespace stackabilization::detail
