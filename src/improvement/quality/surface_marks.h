#pragma once

#include <cstdint>
#include <vector>

#include "stackabilization/core/shape.h"

namespace stackabilization::detail {

/// Points of a surface that move with it: each is given by a triangle and barycentric weights.
struct SurfaceMarks {
  std::vector<std::int32_t> triangles;   ///< rows of Shape::triangles
  std::vector<Eigen::Vector3d> weights;  ///< barycentric
  std::vector<double> areas;             ///< at rest, model units squared; only from `pieces_of`

  std::size_t size() const { return triangles.size(); }
  /// Appends a mark at the nearest point of the triangle's plane. Precondition: the triangle has an area.
  void append(const Shape& rest, std::int32_t triangle, const Eigen::Vector3d& point);
  /// Appends other marks, without areas.
  void append(const SurfaceMarks& others);
  /// Appends a corner of a triangle.
  void append_corner(std::int32_t triangle, int corner);
  /// Returns the places of the marks on `shape`, one per row.
  Points on(const Shape& shape) const;
};

/// Returns the triangles of each part, ascending.
std::vector<std::vector<std::int32_t>> triangles_of_parts(const Shape& shape);

/// Returns `count` marks of equal area on some triangles (surface_samples); none if they have no area.
SurfaceMarks marks_on(const Shape& rest, const std::vector<std::int32_t>& triangles, int count);

/// Returns the outermost vertices of some triangles in the 26 directions of a cube's faces, edges and
/// corners, each once.
SurfaceMarks outermost_vertices(const Shape& rest, const std::vector<std::int32_t>& triangles);

/// Returns the centres of pieces of some triangles, with their areas: the sides of a triangle are cut in n
/// equal parts, none longer than `length`, or than a greater length where there would be more than
/// `max_pieces` pieces. So the marks have the symmetries of the mesh. Of more triangles than that, returns
/// `max_pieces` marks of equal area.
SurfaceMarks pieces_of(const Shape& rest, const std::vector<std::int32_t>& triangles, double length,
                       std::size_t max_pieces);

}  // namespace stackabilization::detail
