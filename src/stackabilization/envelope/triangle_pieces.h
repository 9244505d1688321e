#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "stackabilization/envelope/separation_tree.h"

namespace stackabilization::detail {

/// A convex polygon in space, at most as many corners as a few cuts of a triangle leave.
struct PiecePolygon {
  static constexpr int most_points = 7;
  std::array<std::array<double, 3>, most_points> points;
  int point_count = 0;
};

/// A convex piece of a triangle, by its box. Most pieces are whole triangles and need no polygon of their
/// own.
struct Piece {
  std::array<double, 3> low, high;  ///< widened by the rounding of cut points
  std::int32_t triangle = 0;        ///< row in the list of triangles
  std::int32_t polygon = -1;        ///< row in `Pieces::polygons`; -1: the whole triangle
};

struct Pieces {
  std::vector<Piece> pieces;
  std::vector<PiecePolygon> polygons;
};

/// Pieces that cover all triangles: one per triangle, plus up to about as many again, within a limit, where
/// cutting long triangles shrinks boxes most. Deterministic; the more uniform the mesh, the fewer cuts.
Pieces cut_into_pieces(const std::vector<TreeTriangle>& triangles);

/// The polygon of a piece.
PiecePolygon polygon_of(const Piece& piece, const Pieces& pieces, const std::vector<TreeTriangle>& triangles);

}  // namespace stackabilization::detail
