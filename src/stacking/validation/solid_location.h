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

/// A point inside a triangle, another one for each attempt: on a parabola, by weights that no model has by
/// design.
Point inner_point(const Corners& corner, int attempt);

/// Where a point lies with respect to a closed surface.
enum class PointPlace { outside, inside, boundary };

/// The place of one point; for `boundary` also a triangle that holds it.
struct PointLocation {
  PointPlace place = PointPlace::outside;
  std::int32_t triangle = -1;
};

/// Winding numbers on both sides of a surface.
struct Windings {
  int ahead = 0, behind = 0;
  bool opposed = false;  ///< triangles of both orientations lie there
};

/// Winding numbers about a closed surface, exact for its coordinates and any rational point, by rays through
/// an AABB tree of its triangles. Triangles without area are passed over. Safe to share between threads.
class SolidLocator {
 public:
  /// `solid` must outlive it. Precondition: `validate(solid)`; the answers mean something where it is closed.
  explicit SolidLocator(const Shape& solid);
  SolidLocator(const SolidLocator&) = delete;
  SolidLocator& operator=(const SolidLocator&) = delete;
  ~SolidLocator();

  /// The triangles with area, ascending.
  const std::vector<std::int32_t>& rows() const;
  Corners corners(std::int32_t triangle) const;
  /// Triangles with area that meet a box, ascending.
  std::vector<std::int32_t> triangles_in(const CGAL::Bbox_3& box) const;

  /// `inside` is where the winding number is not 0. Of several triangles that hold a point on the boundary
  /// the first.
  PointLocation locate(const Point& p) const;
  /// How many triangles `windings_beside` looks at for one point.
  std::int64_t count_beside(std::int32_t triangle) const;
  /// Winding numbers right beside an inner point of a triangle with area, on both sides of all triangles that
  /// hold this point.
  Windings windings_beside(std::int32_t triangle) const;

 private:
  struct Tree;

  const Shape& solid_;
  std::unique_ptr<const Tree> tree_;
};

}  // namespace stackabilization::detail
