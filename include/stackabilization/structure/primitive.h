#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <array>
#include <variant>

#include "stackabilization/core/shape.h"
#include "stackabilization/mesh/boxes.h"

namespace stackabilization {

/// A cuboid, given by its eight corners: a box before deformation, a general hexahedron afterwards.
///
/// Corner k lies on the positive side of axis a of the box when bit a of k is set: 0 = (-,-,-), 1 = (+,-,-),
/// 2 = (-,+,-), ..., 7 = (+,+,+). Face f is orthogonal to axis f / 2: on the negative side for even f, on the
/// positive side for odd f.
///
/// A hollow box such as a crate is represented as well: the faces follow its outer walls. A scaling scales
/// its walls too, or with `inner_sides` moves their inner and outer sides by the same distance.
struct Cuboid {
  Eigen::Matrix<double, 8, 3, Eigen::RowMajor> corners;  ///< model units
  /// Per axis, where the walls of a hollow box at rest begin: distances from the centre to their inner sides,
  /// in the negative and in the positive direction, fractions of half the extent, in (0, 1]; 1 where there is
  /// no wall. The analysis leaves them at 1; Following::smooth finds them.
  Eigen::Matrix<double, 3, 2> inner_sides = Eigen::Matrix<double, 3, 2>::Ones();
};

/// A generalized cylinder: circles along a curve, in the order of the curve (paper, section 4.1).
///
/// A hollow body such as a cup is represented as well: the circles follow its outer wall. A move of a circle
/// moves the inner and the outer wall together; a scaling scales both, or with `inner_radii` moves both by
/// the same distance.
struct GeneralizedCylinder {
  /// n x 3 centres of the cross-sections, model units. n >= 2, or n >= 3 for a closed curve. Consecutive
  /// centres differ.
  Points centres;
  Eigen::VectorXd radii;  ///< n radii > 0, model units
  /// Empty, or n radii of the inner side of the wall of a hollow body at rest, model units; 0 where it is
  /// solid, such as in a floor. The analysis leaves them empty; Following::smooth finds them.
  Eigen::VectorXd inner_radii = {};
  bool closed = false;  ///< whether the first section follows the last one, as in rims and ring handles
  /// Rotation of the whole cylinder since rest. The curve does not determine the rotation about its own
  /// tangents.
  Eigen::Quaterniond rotation = Eigen::Quaterniond::Identity();
};

/// Primitive that represents a part in edits, relations and propagation.
using Primitive = std::variant<Cuboid, GeneralizedCylinder>;

/// Returns the corners of a box. The axes of the cuboid are in the order of `box.axes`.
Cuboid cuboid_of(const OrientedBox& box);

/// Returns the rows of `Cuboid::corners` around face `face` (0 to 5). They run counter-clockwise seen from
/// outside for a right-handed box.
std::array<int, 4> cuboid_face(int face);

/// Computes the n x 3 unit tangents of the curve at its sections, by central differences, at open ends by
/// one-sided differences.
Points section_tangents(const GeneralizedCylinder& cylinder);

/// Computes the n arc lengths from the first section to every section, model units. A closed cylinder has n +
/// 1 entries; the last one is the length of the loop.
Eigen::VectorXd section_arc_lengths(const GeneralizedCylinder& cylinder);

/// Returns the control points: the corners of a cuboid, or the centres of a cylinder. Symmetries and energies
/// compare these points.
Points control_points(const Primitive& primitive);

/// Computes the volume of a primitive, model units cubed. For a cuboid it is the volume of the hexahedron,
/// averaged over both diagonals of every face. For a cylinder it is the sum of the cone frusta between
/// neighbouring circles.
double volume(const Primitive& primitive);

/// Throws InputError, with `name` and the defect, unless the invariants above hold and every number is
/// finite.
void validate(const Primitive& primitive, const std::string& name);

}  // namespace stackabilization
