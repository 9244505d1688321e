#pragma once

#include <Eigen/Core>
#include <optional>
#include <vector>

#include "envelope/height_bounds/height_bounds.h"
#include "stacking/place/local_frame.h"

namespace stackabilization::detail {

/// A place with its turn in radians.
struct LocalPlace {
  double x = 0, y = 0, yaw = 0;
};

/// Places with x and y in a rectangle, and a turn of yaw - half_turn to yaw + half_turn.
struct PlaceCell {
  PlanarBox box;
  double yaw = 0, half_turn = 0;  ///< radians
};

/// The allowed places, see PlaceOptions::region.
class PlaceRegion {
 public:
  /// Throws UsageError for a polygon with fewer than three corners, or corners that are not finite.
  PlaceRegion(const LocalShapes& shapes, const std::vector<Eigen::Vector2d>& polygon);

  /// Returns a rectangle that holds all places with a turn in the range of the cell, whatever its box.
  PlanarBox box(double yaw, double half_turn) const;
  /// Returns whether the cell certainly has no allowed place.
  bool excludes(const PlaceCell& cell) const;
  /// Returns an allowed place of the cell with the turn in its middle, at its centre if possible.
  std::optional<LocalPlace> place_in(const PlaceCell& cell) const;

 private:
  /// Range of the centre with this turn so that one of the boxes is within the other.
  PlanarBox inside(double yaw) const;
  bool polygon_contains(double x, double y) const;
  /// A point of the polygon in the rectangle, its centre if possible.
  std::optional<Eigen::Vector2d> polygon_point(const PlanarBox& box) const;

  Outline base_;
  std::vector<Eigen::Vector2d> hull_;     ///< points of the shape that decide its box at any turn
  double radius_ = 0;                     ///< largest distance of these from the origin
  std::vector<Eigen::Vector2d> polygon_;  ///< empty: `inside`
};

}  // namespace stackabilization::detail
