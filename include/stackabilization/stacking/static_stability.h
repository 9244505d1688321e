#pragma once

#include <Eigen/Core>
#include <optional>

#include "stackabilization/core/direction.h"
#include "stackabilization/core/shape.h"
#include "stackabilization/envelope/separation.h"

namespace stackabilization {

/// Options of `standing`.
struct StaticStabilityOptions {
  int copies = 2;                                        ///< n >= 1
  ContactSemantics semantics = ContactSemantics::solid;  ///< semantics of the f_max between copies
  /// Points within this distance of the contact support the copy, fraction of the extent h, in (0, 1).
  double band = 0.002;
  /// Direction against gravity, of any length > 0. If empty, r.
  std::optional<Eigen::Vector3d> up;
  /// Coefficient of Coulomb friction between copies, finite, >= 0. If empty, copies do not slide.
  std::optional<double> friction;
};

/// Static stability of a stack of copies along r, the lowest of which stands on level ground.
struct StaticStability {
  bool stands = false;  ///< whether the stack is stable: the tilt is positive
  /// Tipping angle: the smallest tilt of the ground at which the stack topples, about the worst side of the
  /// worst support. Negative when the stack topples on level ground; 0 at the limit and for supports that are
  /// points or lines. With friction, the smallest tilt at which the stack topples or a copy slides. Degrees,
  /// in [-90, 90].
  double tipping_degrees = 0;
  /// Copy that topples at this tilt, together with the copies above it; 0: the whole stack.
  int weakest_copy = 0;
  Eigen::Vector3d centre_of_mass = Eigen::Vector3d::Zero();  ///< of one copy, model units
  /// Whether the mass is that of the enclosed solid; otherwise that of a shell of uniform thickness.
  bool of_solid = false;
};

/// Returns up, the z axis, where an object stands in a stack along r: where r leans by at most
/// tolerance::max_stack_lean. Nothing where the object lies in its stack, and r is up.
std::optional<Eigen::Vector3d> up_of_stack(const Direction& direction);

/// Computes the static stability of a stack. The stack topples at copy k when, seen from above, the centre of
/// mass of copies k ... n-1 leaves the convex hull of the support of copy k. The support consists of the
/// contacts with the copy below within the band; for copy 0, of the vertices within the band of the lowest
/// vertex. Copies are moved by multiples of f_max along r: where r leans, the stack leans. The tipping angle
/// about a side of the hull is atan(d / H). d is the distance from the side to the centre of mass, seen from
/// above. H is the height of the centre of mass above the side. The angle is 90 degrees when the centre of
/// mass is below the side.
///
/// With friction, a copy and those above it are one body. It stays while there are forces at the contacts,
/// each within its friction cone, that balance its weight (Bretl and Lall 2008). Such forces
/// exist in every stack that stays; a stack that is wedged may have them and slide all the same. Cones are
/// pyramids of 32 sides inside of them, and of more than 96 corners of contacts the 96 most different ones
/// count: both on the safe side. The ground does not let the stack slide.
///
/// Without friction contacts on slopes count as supports, and sliding is ignored. Components of a closed
/// surface are bodies. A component inside the box of a larger one and of opposite orientation is a cavity.
/// Double precision. Throws UsageError for options out of range, and where r does not point upwards. Throws
/// InputError when `validate(shape)` fails, the shape has no area, or its copies pass each other along r.
StaticStability static_stability(const Shape& shape, const Direction& direction,
                                 const StaticStabilityOptions& options = {});

/// Computes the least coefficient of friction with which the copies of such a stack stay as they are on level
/// ground, to tolerance::needed_friction of it; 0: without friction; infinity: with none. The friction of the
/// options is not looked at. Throws as `static_stability`.
double needed_friction(const Shape& shape, const Direction& direction,
                       const StaticStabilityOptions& options = {});

}  // namespace stackabilization
