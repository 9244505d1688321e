#pragma once

#include <atomic>
#include <cstdint>
#include <vector>

#include "stackabilization/core/shape.h"
#include "stackabilization/mesh/closed_surface.h"
#include "stacking/validation/solid_location.h"

namespace stackabilization::detail {

/// A placed shape: exact coordinates of all vertices.
struct Placed {
  const Shape& shape;
  const ClosedSurface& surface;
  std::vector<Point> points;

  std::size_t triangle_count() const { return static_cast<std::size_t>(shape.triangle_count()); }
  const Point& vertex(std::int32_t v) const { return points[static_cast<std::size_t>(v)]; }
  Corners corners(std::int32_t t) const {
    return {vertex(shape.triangles(t, 0)), vertex(shape.triangles(t, 1)), vertex(shape.triangles(t, 2))};
  }
};

/// A shape with its data that do not depend on the placement: the triangles as they are, all reversed where
/// the shape is inside out as a whole. Of triangles with equal corners and neighbours, as in coincident
/// parts, only the first one is tested.
struct ExactBody {
  Shape shape;
  ClosedSurface surface;
  SolidLocator solid;
  std::vector<std::int32_t> first;     ///< per triangle with area the first that is the same, else -1
  std::vector<std::int32_t> distinct;  ///< those, ascending

  /// Throws as `validate(source)`.
  explicit ExactBody(const Shape& source);

  static std::size_t index(std::int32_t row) { return static_cast<std::size_t>(row); }

  bool is_distinct(std::int32_t row) const { return first[index(row)] == row; }

  Placed moved(const Vector& translation) const;

  /// Returns the triangles that may lie inside another solid although no triangle crosses its surface: the
  /// triangles that touch it, and one triangle of every component. Neighbours that do not touch it are on the
  /// same side.
  std::vector<std::int32_t> candidates(const std::vector<std::atomic<bool>>& touched) const;
};

}  // namespace stackabilization::detail
