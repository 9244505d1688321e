#pragma once

#include <cstdint>
#include <vector>

#include "stackabilization/core/direction.h"
#include "stackabilization/core/shape.h"
#include "stackabilization/envelope/separation.h"

namespace stackabilization {

/// How a triangle leaves a mould of two halves that part along r.
struct TriangleDraft {
  /// Angle between the triangle and r, degrees in [0, 90]: 0 for a wall along r, which has a slope of at most
  /// 1e-5 against it.
  double angle = 0;
  double area = 0;  ///< model units squared, of the triangle and not of its projection, here and below
  /// Area of the portion that neither half of the mould can leave: along r, other triangles lie above it and
  /// others below it. Of a wall along r they do so beside it, on both sides.
  double undercut_area = 0;
  /// Area of the portion inside the solid, as where parts overlap or touch. It is no surface of the object.
  double inner_area = 0;

  /// Returns the area that leaves the mould, model units squared.
  double free_area() const { return area - undercut_area - inner_area; }
};

/// One convex piece of an undercut.
struct UndercutPiece {
  std::int32_t triangle;  ///< row of Shape::triangles
  Points corners;         ///< k x 3, on the triangle, in order, model units
};

/// Undercuts and draft of a shape.
struct DraftAnalysis {
  std::vector<TriangleDraft> triangles;  ///< one per triangle of the shape
  std::vector<UndercutPiece> undercuts;  ///< in the order of their triangles; pieces may overlap
  /// Whether all pairs of triangles above each other were examined. Otherwise areas of undercuts are lower
  /// bounds.
  bool complete = true;
};

/// Finds what keeps a shape in a mould of two halves that part along r and -r: a surface point is undercut
/// when it lies neither on the upper nor on the lower envelope. The visible portions of triangles are
/// polygons, computed in double precision within tolerance::relative of the diagonal; those of walls along r
/// are decided tolerance::beside_surface beside them. A triangle with more than 4096 pieces is measured along
/// scan lines, to about a thousandth. The shape may be open.
///
/// Inner portions are pieces with closed parts on both sides, by exact tests of some of their points.
/// Triangles with the same points hide others as one, and have the same result. Work is bounded, see
/// `complete`: 16 pairs per triangle plus 2^16, 2^13 triangles above and below a wall, 2^16 pairs of pieces
/// of one triangle. Deterministic for any number of threads. Precondition: `tree` is the tree of `shape`.
DraftAnalysis analyse_draft(const Shape& shape, const SeparationTree& tree, const Direction& direction);

}  // namespace stackabilization
