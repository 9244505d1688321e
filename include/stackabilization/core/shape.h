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

/// Length unit that a file states or a user gives. `unknown` means that numbers are printed without a unit.
enum class Unit { unknown, micrometre, millimetre, centimetre, metre, inch, foot };

/// A finite set of triangles with double coordinates, cut into named parts.
///
/// It may be open, non-manifold, self-intersecting and inconsistently oriented: real models are. Nothing in
/// this library merges, drops or reorders triangles of a Shape behind the caller's back.
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

  /// n: rows of `vertices`, those that no triangle uses included.
  Eigen::Index vertex_count() const { return vertices.rows(); }
  Eigen::Index triangle_count() const { return triangles.rows(); }  ///< m, triangles without area included
  Eigen::Index part_count() const { return static_cast<Eigen::Index>(part_names.size()); }  ///< k

  /// Corner `corner` (0, 1, 2) of triangle `triangle`, model units.
  Eigen::Vector3d corner(Eigen::Index triangle, int corner) const {
    return vertices.row(triangles(triangle, corner)).transpose();
  }
};

/// Shape of one part named "part". Throws InputError when the invariants of Shape do not hold.
Shape make_shape(Points vertices, Triangles triangles);

/// Throws InputError, naming the first offending triangle, vertex or part, unless the invariants of Shape
/// hold and there is at least one triangle.
void validate(const Shape& shape);

/// Two numbers, low <= high.
struct Range {
  double low, high;  ///< low <= high

  double length() const { return high - low; }  ///< high - low, >= 0
};

/// Range of axis . p over the corners p of all triangles. Precondition: at least one triangle.
Range range_along(const Shape& shape, const Eigen::Vector3d& axis);

/// The triangles of part `part` (index into `part_names`) with the vertices they use, in their order in
/// `shape`.
Shape extract_part(const Shape& shape, Eigen::Index part);

/// All triangles of both, parts of `b` renamed "NAME_2" and so on where a name is taken already.
Shape concatenate(const Shape& a, const Shape& b);

/// p -> rotation * p + translation for every vertex, each coordinate rounded to double. Throws UsageError
/// when `linear` or `translation` is not finite.
Shape transformed(const Shape& shape, const Eigen::Matrix3d& linear, const Eigen::Vector3d& translation);

/// Metres per unit; 1 for `unknown`.
double metres_per_unit(Unit unit);

/// "mm", "cm", "m", "in", "ft", "um"; empty for `unknown`.
std::string unit_symbol(Unit unit);

}  // namespace stackabilization
