#pragma once

#include <CGAL/Bbox_3.h>
#include <CGAL/Exact_predicates_exact_constructions_kernel.h>

#include <array>
#include <cstdint>
#include <memory>
#include <vector>

#include "stackabilization/core/shape.h"

namespace stackabilization::detail {

using Exact = CGAL::Exact_predicates_exact_constructions_kernel;
using Point = Exact::Point_3;
using Vector = Exact::Vector_3;
using Number = Exact::FT;
using Corners = std::array<Point, 3>;

/// Returns a point inside a triangle, a different one for each attempt. The points lie on a parabola; their
/// weights are unlikely to coincide with features of a model.
Point inner_point(const Corners& corner, int attempt);

/// Location of a point with respect to a closed surface.
enum class PointPlace { outside, inside, boundary };

/// Location of one point. A boundary point also names a triangle that contains it.
struct PointLocation {
  PointPlace place = PointPlace::outside;
  std::int32_t triangle = -1;
};

/// Winding numbers on both sides of a surface.
struct Windings {
  int ahead = 0, behind = 0;
  bool opposed = false;  ///< whether triangles of both orientations lie there
};

/// Winding numbers about a closed surface, by rays through an AABB tree of its triangles. Exact for the
/// coordinates of the surface and any rational point. Triangles without area are ignored. Safe to share
/// between threads.
class SolidLocator {
 public:
  /// `solid` must outlive this object. Precondition: `validate(solid)`. Results are meaningful for closed
  /// surfaces only.
  explicit SolidLocator(const Shape& solid);
  SolidLocator(const SolidLocator&) = delete;
  SolidLocator& operator=(const SolidLocator&) = delete;
  ~SolidLocator();

  /// Returns the triangles with area, ascending.
  const std::vector<std::int32_t>& rows() const;
  Corners corners(std::int32_t triangle) const;
  /// Returns the triangles with area that meet a box, ascending.
  std::vector<std::int32_t> triangles_in(const CGAL::Bbox_3& box) const;

  /// Locates a point. A point is inside when its winding number is not 0. A boundary point names the first
  /// triangle that contains it.
  PointLocation locate(const Point& p) const;
  /// Returns the number of triangles that `windings_beside` examines for one point.
  std::int64_t count_beside(std::int32_t triangle) const;
  /// Computes the winding numbers directly beside an inner point of a triangle with area, on both sides of
  /// all triangles that contain this point.
  Windings windings_beside(std::int32_t triangle) const;

 private:
  struct Tree;

  const Shape& solid_;
  std::unique_ptr<const Tree> tree_;
};

}  // namespace stackabilization::detail
