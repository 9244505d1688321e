#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <string>
#include <vector>

namespace stackabilization {

/// n x 3, one point per row, model units.
using Points = Eigen::Matrix<double, Eigen::Dynamic, 3, Eigen::RowMajor>;

/// m x 3, one triangle per row, 0-based rows of the vertex matrix.
using Triangles = Eigen::Matrix<std::int32_t, Eigen::Dynamic, 3, Eigen::RowMajor>;

/// Length unit according to the file or the user. With `unknown`, numbers are printed without a unit.
enum class Unit { unknown, micrometre, millimetre, centimetre, metre, inch, foot };

/// A finite set of triangles with double coordinates, divided into named parts.
///
/// It may be open, non-manifold, self-intersecting and inconsistently oriented, as real models are. No
/// function of this library implicitly merges, drops or reorders the triangles of a Shape.
///
/// Invariants (checked by `validate`): triangle entries are valid vertex rows; `triangle_part` has one entry
/// per triangle, each a valid index into `part_names`; a shape with triangles has at least one part; every
/// coordinate that a triangle uses is finite.
struct Shape {
  Points vertices;                          ///< n x 3, model units.
  Triangles triangles;                      ///< m x 3.
  std::vector<std::string> part_names;      ///< k names in UTF-8, in file order; unique and non-empty.
  std::vector<std::int32_t> triangle_part;  ///< m entries in [0, k).
  Unit unit = Unit::unknown;                ///< Unit of `vertices`.

  /// Returns n, the rows of `vertices`, including vertices that no triangle uses.
  Eigen::Index vertex_count() const { return vertices.rows(); }
  Eigen::Index triangle_count() const { return triangles.rows(); }  ///< m, including triangles without area
  Eigen::Index part_count() const { return static_cast<Eigen::Index>(part_names.size()); }  ///< k

  /// Returns corner `corner` (0, 1, 2) of triangle `triangle`, model units.
  Eigen::Vector3d corner(Eigen::Index triangle, int corner) const {
    return vertices.row(triangles(triangle, corner)).transpose();
  }
};

/// Creates a shape with one part, named "part". Throws InputError when the invariants of Shape do not hold.
Shape make_shape(Points vertices, Triangles triangles);

/// Throws InputError, naming the first offending triangle, vertex or part, unless the invariants of Shape
/// hold and there is at least one triangle.
void validate(const Shape& shape);

/// Two numbers, low <= high.
struct Range {
  double low, high;  ///< low <= high

  double length() const { return high - low; }  ///< high - low, >= 0
};

/// Returns the range of axis . p over the corners p of all triangles. Precondition: at least one triangle.
Range range_along(const Shape& shape, const Eigen::Vector3d& axis);

/// Returns the triangles of part `part` (index into `part_names`) with the vertices that they use, in the
/// order of `shape`.
Shape extract_part(const Shape& shape, Eigen::Index part);

/// Returns all triangles of both shapes. A part of `b` whose name exists in `a` becomes "NAME_2" and so on.
Shape concatenate(const Shape& a, const Shape& b);

/// Applies p -> linear * p + translation to every vertex, each coordinate rounded to double. Throws
/// UsageError when `linear` or `translation` is not finite.
Shape transformed(const Shape& shape, const Eigen::Matrix3d& linear, const Eigen::Vector3d& translation);

/// Returns the metres per unit, and 1 for `unknown`.
double metres_per_unit(Unit unit);

/// Returns "mm", "cm", "m", "in", "ft" or "um", and an empty text for `unknown`.
std::string unit_symbol(Unit unit);

}  // namespace stackabilization
