#pragma once

#include <Eigen/Core>
#include <cmath>
#include <limits>
#include <optional>
#include <utility>

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

/// A bound at the places (x, y) of a cell: `centre` + `slope` . ((x, y) - the centre of the cell).
struct LinearBound {
  double centre = 0;
  Eigen::Vector2d slope = Eigen::Vector2d::Zero();

  /// Returns how far it gets from `centre` within the cell.
  double spread(const PlaceCell& cell) const {
    return std::abs(slope.x()) * cell.box.width() / 2 + std::abs(slope.y()) * cell.box.height() / 2;
  }
};

/// Bounds of the two surfaces that face each other, over a rectangle of one of them and all places of a cell.
struct FacingBound {
  HeightBound own;         ///< of -l, or of u for a rectangle of the base
  HeightBound difference;  ///< of u - l, where the base is below the shape
  bool all_faced = false;  ///< the other surface is certainly there for all of the rectangle
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

  /// Returns bounds of what faces each other over a rectangle of the shape.
  FacingBound facing(const PlaceCell& cell, const PlanarBox& part);
  /// Returns bounds, from below and from above, of the mean of u - l over a rectangle of the shape that both
  /// cover. Where both are flat they are the same.
  std::pair<LinearBound, LinearBound> mean_difference(const PlaceCell& cell, const PlanarBox& part);
  /// Returns a bound of the lifts of a cell, from below, by the rectangle that showed one.
  LinearBound lift(const PlaceCell& cell, const CellBound& bound);
  /// Returns the largest coordinate of both.
  double size() const { return size_; }
  /// Returns bounds of the areas of the two, seen along the third axis.
  Range area_of_base() { return base_.up.covered_area(area_rectangles); }
  Range area_of_shape() { return shape_.down.covered_area(area_rectangles); }
  /// Returns the box of the shape across the third axis.
  const PlanarBox& box_of_shape() const { return shape_.down.box(); }

 private:
  static constexpr int area_rectangles = 1 << 14;

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
