#pragma once

#include <limits>
#include <optional>

#include "envelope/height_bounds/height_bounds.h"
#include "mesh/welded_mesh.h"
#include "stacking/place/place_region.h"

namespace stackabilization::detail {

/// A rectangle of one of the shapes, in its own coordinates, that shows a lower bound.
struct BoundWitness {
  bool of_shape = true;  ///< of the shape that comes down, or of the base
  PlanarBox part{};
};

/// A lower bound of the separation over a cell of places.
struct CellBound {
  /// Of the lift of the local coordinates, model units; -inf where nothing is known.
  double low = -std::numeric_limits<double>::infinity();
  std::optional<BoundWitness> witness;  ///< nothing: of a larger cell, or none
};

/// Lower bounds of the separation of two shapes along the third axis, over cells of places.
///
/// For a point q of the shape and a place p, the lift is at least u(p(q)) - l(q), where u is the upper
/// envelope of the base and l the lower envelope of the shape. Over all places of a cell and all q of a
/// rectangle, p(q) stays in a rectangle; the smallest u over that minus the largest l over the first is a
/// bound. The same holds with the shapes changed round. The search for a rectangle with a large bound is best
/// first, by an upper bound of what a rectangle can show.
class PlaceBounds {
 public:
  explicit PlaceBounds(const LocalShapes& shapes);

  /// Returns what the quarters of a rectangle show that showed a bound of a cell around this one.
  CellBound bound(const PlaceCell& cell, const BoundWitness& of_cell_around);
  /// Returns what rectangles around points of the shape and of the base show that touch at a place of the
  /// cell.
  CellBound bound_near(const PlaceCell& cell, const Eigen::Vector2d& of_shape,
                       const Eigen::Vector2d& of_base);
  /// Searches a rectangle that shows `enough`, and returns the best of those seen.
  CellBound search(const PlaceCell& cell, double enough);

 private:
  class Side;
  /// A shape that is welded, with bounds of its upper envelope and of its mirror image.
  struct Surface {
    WeldedMesh mesh;
    EdgeTable edges;
    HeightBounds up, down;  ///< of the upper envelope, and of minus the lower one

    Surface(const Shape& shape, double error);
  };

  double size_;
  Surface base_, shape_;
};

}  // namespace stackabilization::detail
