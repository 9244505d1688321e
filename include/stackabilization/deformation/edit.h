#pragma once

#include <Eigen/Core>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "stackabilization/core/direction.h"
#include "stackabilization/core/shape.h"

namespace stackabilization {

/// What a user or a search takes hold of. `part` and `index` are used as said.
enum class HandleKind {
  part,     ///< `part` as a whole
  face,     ///< face `index` (0 to 5) of the cuboid of `part`
  corner,   ///< corner `index` (0 to 7) of the cuboid of `part`
  section,  ///< cross-section `index` of the generalized cylinder of `part`
  point,    ///< vertex `index` of the shape, with the surface around it
  wire,     ///< feature curve `index`
  shape,    ///< everything
};

/// Which handle: HandleKind says what `part` and `index` mean.
struct Handle {
  HandleKind kind = HandleKind::part;  ///< what it is
  int part = 0;                        ///< row of Shape::part_names
  int index = 0;                       ///< 0-based

  /// Equal in all three, also in those that its kind does not use.
  bool operator==(const Handle&) const = default;
};

/// Numbers that edits take. What lies beyond is a typing error or a wrong unit, and would leave nothing of
/// the accuracy that is promised.
namespace edit_limits {
inline constexpr double max_move = 1000;          ///< diagonals of the shape's bounding box that a move goes
inline constexpr double max_scale = 1e6;          ///< factors lie between one over this and this
inline constexpr double max_degrees = 3600;       ///< of a rotation, either way
inline constexpr double max_fixed_distance = 10;  ///< diagonals between a fixed point and that box
}  // namespace edit_limits

/// Translation, model units.
struct Move {
  Eigen::Vector3d by = Eigen::Vector3d::Zero();  ///< file axes, model units
};

/// Rotation about the handle's centre.
struct Rotate {
  Eigen::Vector3d axis = Eigen::Vector3d::UnitZ();  ///< of any length that a Direction may have
  double radians = 0;                               ///< right-handed about `axis`
};

/// Scaling about the handle's centre: of a cross-section its radius, of a face within its plane, of the rest
/// in all directions or along one.
struct Scale {
  double factor = 1;                     ///< > 0
  std::optional<Eigen::Vector3d> along;  ///< as the axis of a rotation; only for parts and shapes
};

/// What is done to a handle.
using Operation = std::variant<Move, Rotate, Scale>;

/// How a move or scaling of a cross-section dies out along its generalized cylinder.
enum class Falloff {
  gaussian,  ///< over the arc length, sigma = 0.2 of the whole (paper, section 4.1)
  /// To nothing at the end that is farther away along the curve at rest (from the middle: the last section),
  /// and on beyond the handle: what is straight leans, walls become conical. Of a part that a symmetry turns
  /// end for end, the mean with the image of that: it moves sideways and widens evenly, and is stretched.
  linear,
};

/// One operation on one handle. `falloff` is looked at for moves and scalings of cross-sections of open
/// generalized cylinders only.
struct Edit {
  Handle handle;                        ///< what is taken hold of
  Operation operation;                  ///< what is done to it
  Falloff falloff = Falloff::gaussian;  ///< how it dies out from section to section
};

/// What can be said without the shape. Throws UsageError, in words that say what was found, unless every
/// number is finite, factors and angles are within `edit_limits`, and axes are such as a Direction takes: not
/// zero, with a length whose square neither overflows nor underflows.
void validate(const Edit& edit);

/// The same for an edit of a shape whose bounding box has this diagonal: throws UsageError too for a move
/// that goes farther than `edit_limits` says.
void validate(const Edit& edit, double diagonal);

/// Does `falloff` change what the edit does, where the cross-section is one of an open generalized cylinder?
bool falls_off_linearly(const Edit& edit);

/// "move face +y of leg by (0.1, 0, 0)", "scale cross-section 4 of leg by 0.9, linearly": numbers to five
/// digits, those of a vector to the places of its largest, -0 as 0. `part_names` are those of the shape.
/// Precondition: the handle's part is one of them and its face one of six, where its kind needs them.
std::string describe(const Edit& edit, const std::vector<std::string>& part_names);

/// Where a kept extent begins and ends.
enum class ExtentEnds {
  free,   ///< anywhere: what an edit moves along the direction may take everything along
  fixed,  ///< where they are at rest: what an edit moves, it moves against the rest, and moves across the
          ///< direction leave heights open. Controllers only; the other models move nothing that they need
          ///< not
};

/// What no edit may change.
struct DeformationConstraints {
  /// The extent h(M, r) along this direction is kept, to tolerance::relative of it.
  std::optional<Direction> keep_extent;
  ExtentEnds extent_ends = ExtentEnds::free;  ///< of `keep_extent`
  /// The three sides of the axis-aligned box of the shape may change by this fraction at most.
  std::optional<double> box_tolerance;
  std::vector<int> fixed_parts;               ///< parts that stay as they are
  std::vector<Eigen::Vector3d> fixed_points;  ///< points of the surface that stay: the nearest ones to these
};

/// Throws UsageError unless the fixed parts are parts of the shape, every fixed point lies as near to its
/// bounding box as `edit_limits` says, and the tolerance of the box is finite and not negative.
void validate(const DeformationConstraints& constraints, const Shape& rest);

}  // namespace stackabilization
