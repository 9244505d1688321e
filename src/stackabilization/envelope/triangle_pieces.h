#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "stackabilization/envelope/separation_tree.h"

namespace stackabilization::detail {

/// A convex piece of a triangle. Long triangles are cut so that boxes fit closely; the pieces of one triangle
/// cover it.
struct Piece {
  static constexpr int most_points = 7;
  std::array<std::array<double, 3>, most_points> points;
  int point_count = 0;
  std::int32_t triangle = 0;        ///< row in the list of triangles
  std::array<double, 3> low, high;  ///< box, widened by the rounding of cut points
};

/// One piece per triangle, plus about as many again where cutting shrinks boxes most. Deterministic; the more
/// uniform the mesh, the fewer cuts.
std::vector<Piece> cut_into_pieces(const std::vector<TreeTriangle>& triangles);

}  // namespace stackabilization::detail
