#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <vector>

#include "stackabilization/core/direction.h"
#include "stackabilization/mesh/boxes.h"

namespace stackabilization::detail {

/// A convex body seen along a direction n: the volume of the box along n, and lower bounds of the volumes of
/// boxes along directions nearby.
///
/// The corners that support the box along n, and those that support each rectangle around the outline, lie in
/// the body and so bound its extents along other directions from below. Seen along directions on a great
/// circle, the distance of two corners along an axis that turns with the view is a sinusoid plus a constant.
class BoxView {
 public:
  /// Precondition: `unit` times the coordinates of the hull have volumes that neither overflow nor underflow.
  BoxView(const HullSupport& hull, const Eigen::Vector3d& normal, double unit);

  /// Returns the volume of the smallest box along n by rotating calipers, in `unit`s cubed. Short sides of
  /// the outline, whose direction is mostly rounding, can make it smaller than it is.
  double volume() const { return volume_; }
  /// Returns a lower bound of the volume of boxes along `other`, a unit vector less than a right angle from
  /// n; `unit`s cubed. It is tight to first order, and on the way from n to `other` it is nowhere less than
  /// at one of the ends, but for terms of second order.
  double bound_along(const Eigen::Vector3d& other) const;
  /// Returns a lower bound of the volume of boxes along all directions within `angle` of n, radians below a
  /// right angle; `unit`s cubed.
  double bound_within(double angle) const;

 private:
  /// Rectangles around the outline whose first axis turns from `from` to `to`. They are supported by the same
  /// corners. Coordinates are those of `frame_`.
  struct Turn {
    Eigen::Vector2d from, to;       ///< unit
    Eigen::Vector3d side;           ///< of the outline, flush with a side of the rectangle along `from`
    std::size_t caliper;            ///< that side of the rectangle: 0 below, 1 right, 2 above, 3 left
    Eigen::Vector3d along, across;  ///< from one supporting corner to the other, along the axis and across it
  };

  /// Calls `product` with each turn and each of its ends, and returns the least result.
  template <typename Product>
  double least(const Product& product) const;

  Frame frame_;
  Eigen::Vector3d height_;  ///< from the lowest corner to the highest one, in `frame_`
  std::vector<Turn> turns_;
  double volume_ = 0;
};

}  // namespace stackabilization::detail
