#pragma once

#include <array>

#include "envelope/separation/separation_tree.h"
#include "envelope/separation/shear.h"

namespace stackabilization::detail {

/// A shear with the rounding errors of its coordinates for all points of the two shapes of a query.
struct Projection {
  Shear shear;
  double magnitude;         ///< largest absolute coordinate of what is projected
  double x_error, y_error;  ///< bounds on |computed - exact| of projected coordinates
  ContactSemantics semantics;

  Projection(const Direction& direction, double largest_coordinate, ContactSemantics s)
      : shear(direction),
        magnitude(largest_coordinate),
        x_error(shear.x_error(magnitude)),
        y_error(shear.y_error(magnitude)),
        semantics(s) {}
};

/// A triangle seen along a direction: projected corners in double, heights exact.
struct ProjectedTriangle {
  const TreeTriangle* source = nullptr;  ///< must outlive this
  std::array<double, 3> x, y, h;
  double x_low, x_high, y_low, y_high, h_low, h_high;
  double area, area_error;  ///< twice the signed projected area: computed value, bound on its error

  ProjectedTriangle() = default;
  ProjectedTriangle(const TreeTriangle& triangle, const Projection& projection);

  bool possibly_edge_on() const { return !(area > area_error) && !(area < -area_error); }
};

/// Certified bounds on the largest height difference (upper minus lower) over common columns of two
/// triangles. `low` is -inf unless the triangles certainly have common columns; `high` is -inf if they
/// certainly have none.
struct PairBounds {
  DoubleDouble low{-infinity, 0};
  DoubleDouble high{-infinity, 0};
};

/// Computes the bounds of one pair. Most pairs cost one or two comparisons. A pair that cannot exceed `floor`
/// returns early with a high of -inf. Corners that are the same point of space count as such: no rounding
/// makes neighbours of a surface that lie side by side overlap, or lifts the point that they share.
PairBounds bound_pair(const ProjectedTriangle& upper, const ProjectedTriangle& lower,
                      const Projection& projection, const DoubleDouble& floor);

}  // namespace stackabilization::detail
