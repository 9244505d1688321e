#pragma once

#include <Eigen/Core>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "stackabilization/core/direction.h"
#include "stackabilization/core/shape.h"

namespace stackabilization {

/// Kinds of handles, the elements of a shape that a user or a search edits. The kind determines how
/// Handle::part and Handle::index are used.
enum class HandleKind {
  part,     ///< `part` as a whole
  face,     ///< face `index` (0 to 5) of the cuboid of `part`
  corner,   ///< corner `index` (0 to 7) of the cuboid of `part`
  section,  ///< cross-section `index` of the generalized cylinder of `part`
  point,    ///< vertex `index` of the shape, with the surface around it
  wire,     ///< feature curve `index`
  shape,    ///< the whole shape
};

/// Returns the names of the kinds in their order: those of the enumerators.
const std::vector<std::string>& handle_kind_names();

/// Identifies a handle. `kind` determines the meaning of `part` and `index`.
struct Handle {
  HandleKind kind = HandleKind::part;  ///< kind of the handle
  int part = 0;                        ///< row of Shape::part_names
  int index = 0;                       ///< 0-based number of the face, corner, cross-section, vertex or curve

  /// Compares all three members, including those that the kind does not use.
  bool operator==(const Handle&) const = default;
};

/// Limits on the numbers of an edit. Numbers beyond the limits indicate a typing error or a wrong unit, and
/// would destroy the promised accuracy.
namespace edit_limits {
inline constexpr double max_move = 1000;     ///< largest translation, diagonals of the shape's bounding box
inline constexpr double max_scale = 1e6;     ///< largest scale factor; the smallest is 1 / max_scale
inline constexpr double max_degrees = 3600;  ///< largest angle of a rotation in either direction, degrees
/// Largest distance of a fixed point from the shape's bounding box, diagonals of that box.
inline constexpr double max_fixed_distance = 10;
}  // namespace edit_limits

/// Translation of a handle.
struct Move {
  Eigen::Vector3d by = Eigen::Vector3d::Zero();  ///< translation vector, file axes, model units
};

/// Rotation about the centre of the handle.
struct Rotate {
  Eigen::Vector3d axis = Eigen::Vector3d::UnitZ();  ///< rotation axis, of any length that a Direction accepts
  double radians = 0;                               ///< angle, right-handed about `axis`
};

/// Scaling about the centre of the handle. It scales the radius of a cross-section, a face within its plane,
/// and the other handles in all directions or along one direction.
struct Scale {
  double factor = 1;  ///< scale factor, > 0
  /// Direction of a scaling along one direction, of any length that a Direction accepts; only for parts and
  /// the shape.
  std::optional<Eigen::Vector3d> along;
};

/// Taper of the whole shape: legs and walls lean, rims keep their size while a base shrinks or grows. Every
/// point moves across `axis`, away from the line along `axis` through the centre of the shape: not at the end
/// of the shape that is lowest along `axis`, by the factor at the highest one, linearly between. Heights
/// along `axis` do not change. What is thin across `axis` (below tolerance::thin_in_taper of the width of the
/// shape) is carried along and keeps its thickness, and straight parts stay straight. Only for the shape,
/// with controllers.
struct Taper {
  double factor = 1;                                ///< ratio of the widths at the highest end, > 0
  Eigen::Vector3d axis = Eigen::Vector3d::UnitZ();  ///< axis, of any length that a Direction accepts
  /// Direction of the only widths that change, across `axis` within tolerance::relative.
  std::optional<Eigen::Vector3d> along;
};

/// Leaning of a part: each of its control points moves by the fraction of `by` at which it lies along `axis`,
/// from 0 at the lowest one to 1 at the highest. Heights along `axis` do not change, nor do radii, and all
/// sections turn with the axis: a frame of bent tube leans, its tube stays round, and sides in one plane stay
/// in one. Where an extent across `by` is kept with fixed ends, heights along it may change, as for a foot
/// that leans. Only for parts, with controllers.
struct Lean {
  Eigen::Vector3d by =
      Eigen::Vector3d::Zero();  ///< across `axis` within tolerance::relative, file axes, model units
  Eigen::Vector3d axis = Eigen::Vector3d::UnitZ();  ///< axis, of any length that a Direction accepts
};

/// Operation that an edit applies to its handle.
using Operation = std::variant<Move, Rotate, Scale, Taper, Lean>;

/// How the effect of a move or scaling of a cross-section decreases along its generalized cylinder.
enum class Falloff {
  gaussian,  ///< Gaussian of the arc length, sigma = 0.2 of the total length (paper, section 4.1)
  /// Linear function of the arc length before the edit (for a straight cylinder, of the position along its
  /// chord): 1 at the handle and 0 at the end that is farther from it along the curve (from the middle: the
  /// last section). The function continues linearly beyond the handle. A straight part therefore leans, and a
  /// wall becomes conical. A part that a symmetry maps onto itself with exchanged ends receives the mean of
  /// the effect and its image: it moves sideways, widens evenly and stretches.
  linear,
};

/// One operation on one handle. `falloff` applies only to moves and scalings of cross-sections of open
/// generalized cylinders.
struct Edit {
  Handle handle;                        ///< handle to edit
  Operation operation;                  ///< operation to apply
  Falloff falloff = Falloff::gaussian;  ///< decrease of the effect from section to section
};

/// Checks an edit without reference to a shape. Throws UsageError, with a message that states the value
/// found, unless all numbers are finite, factors and angles are within `edit_limits`, and each axis is one
/// that a Direction accepts: not zero, with a length whose square neither overflows nor underflows.
void validate(const Edit& edit);

/// Checks an edit of a shape whose bounding box has the given diagonal, model units. Throws UsageError under
/// the conditions of `validate(edit)`, and for a move or leaning by more than edit_limits::max_move times the
/// diagonal.
void validate(const Edit& edit, double diagonal);

/// Returns whether `falloff` changes the effect of the edit, provided that its cross-section is one of an
/// open generalized cylinder.
bool falls_off_linearly(const Edit& edit);

/// Describes an edit in words: "move face +y of leg by (0.1, 0, 0)", "scale cross-section 4 of leg by 0.9,
/// linearly". Numbers have at most five significant digits. The components of a vector have the decimal
/// places of its largest component. -0 is written as 0. `part_names`: those of the shape. Precondition, for
/// the kinds of handles that use these members: the part is a row of `part_names`, and the face is one of
/// six.
std::string describe(const Edit& edit, const std::vector<std::string>& part_names);

/// Heights at which the ends of a kept extent may lie.
enum class ExtentEnds {
  free,  ///< any heights: an edit along the direction may move the whole shape along
  /// The heights at rest. An edit along the direction moves its handle relative to the other parts. An edit
  /// across the direction leaves the heights of its handle free. Only ControllerModel distinguishes `fixed`
  /// from `free`: the other models move no more than an edit needs.
  fixed,
};

/// Quantities that no edit may change.
struct DeformationConstraints {
  /// Direction r whose extent h(M, r) is kept, within tolerance::relative of the extent.
  std::optional<Direction> keep_extent;
  ExtentEnds extent_ends = ExtentEnds::free;  ///< ends of the extent along `keep_extent`
  /// Largest relative change of each of the three sides of the shape's axis-aligned box.
  std::optional<double> box_tolerance;
  std::vector<int> fixed_parts;  ///< parts that do not change, rows of Shape::part_names
  /// Points, file axes, model units: for each of them the nearest point of the surface does not move.
  std::vector<Eigen::Vector3d> fixed_points;
};

/// Throws UsageError unless every fixed part is a part of the shape, every fixed point lies within
/// edit_limits::max_fixed_distance of its bounding box, and the tolerance of the box is finite and not
/// negative.
void validate(const DeformationConstraints& constraints, const Shape& rest);

}  // namespace stackabilization
