#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <array>
#include <variant>

#include "stackabilization/core/shape.h"
#include "stackabilization/mesh/boxes.h"

namespace stackabilization {

/// A cuboid by its eight corners: a box while undeformed, any hexahedron of the same corners afterwards.
///
/// Corner k lies on the positive side of the box's axis a where bit a of k is set: 0 = (-,-,-), 1 = (+,-,-),
/// 2 = (-,+,-), ..., 7 = (+,+,+). Face f lies across axis f / 2, on the negative side for even f, on the
/// positive for odd f.
struct Cuboid {
  Eigen::Matrix<double, 8, 3, Eigen::RowMajor> corners;  ///< model units
};

/// A generalized cylinder: circles threaded on a curve, in the order of the curve (paper, section 4.1).
///
/// A hollow body such as a cup is one as well: its circles hold the outer wall, and whatever moves or scales
/// a circle moves inner and outer wall together.
struct GeneralizedCylinder {
  Points centres;  ///< n x 3 centres of the cross-sections, model units; n >= 2, closed: n >= 3; neighbours
                   ///< differ
  Eigen::VectorXd radii;  ///< n radii > 0, model units
  bool closed = false;    ///< the last section is followed by the first: rims, ring handles
  /// Rotation of the whole since rest. The curve cannot tell how far it was turned about its own tangents.
  Eigen::Quaterniond rotation = Eigen::Quaterniond::Identity();
};

/// What stands for a part in edits, relations and propagation.
using Primitive = std::variant<Cuboid, GeneralizedCylinder>;

/// The corners of a box, its axes in the order of `box.axes`.
Cuboid cuboid_of(const OrientedBox& box);

/// Rows of `Cuboid::corners` around face `face` (0 to 5), counter-clockwise from outside while the box is
/// right-handed.
std::array<int, 4> cuboid_face(int face);

/// n x 3 unit tangents of the curve at its sections: central differences, one-sided at open ends.
Points section_tangents(const GeneralizedCylinder& cylinder);

/// n arc lengths of the sections from the first, model units; for a closed one n + 1 entries, the last of
/// them the length of the loop.
Eigen::VectorXd section_arc_lengths(const GeneralizedCylinder& cylinder);

/// The control points: corners of a cuboid, centres of a cylinder. What symmetries and energies compare.
Points control_points(const Primitive& primitive);

/// Volume of the primitive, model units cubed: of the hexahedron with its faces cut along both diagonals and
/// averaged; of the sum of cone frusta between neighbouring circles.
double volume(const Primitive& primitive);

/// Throws InputError, naming `name` and what is wrong, unless the invariants stated above hold and every
/// number is finite.
void validate(const Primitive& primitive, const std::string& name);

}  // namespace stackabilization
