#pragma once

#include <Eigen/Core>

#include "stackabilization/core/direction.h"
#include "stackabilization/core/shape.h"
#include "stackabilization/envelope/separation.h"

namespace stackabilization {

/// The stack whose standing is judged.
struct StaticStabilityOptions {
  int copies = 2;                                        ///< n >= 1
  ContactSemantics semantics = ContactSemantics::solid;  ///< of the f_max between copies
  /// Points within this of the contact, fraction of the extent h, carry; in (0, 1).
  double band = 0.002;
};

/// Whether a stack of copies along r, with r upwards and the lowest copy on level ground, stands by itself.
struct StaticStability {
  bool stands = false;  ///< the tilt is positive
  /// Least tilt of the ground at which it topples, about the worst side of the worst support; negative when
  /// it topples on level ground, 0 on the verge of it and on supports that are points or lines. Degrees, in
  /// [-90, 90].
  double tipping_degrees = 0;
  int weakest_copy = 0;  ///< that topples at this tilt, with those above it; 0: the whole stack on the ground
  Eigen::Vector3d centre_of_mass = Eigen::Vector3d::Zero();  ///< of one copy, model units
  bool of_solid = false;  ///< the mass is that of the enclosed solid; else of a shell of even thickness
};

/// The stack topples at copy k when the centre of mass of copies k ... n-1 leaves the convex hull of the
/// points on which copy k rests (contacts with the copy below within the band; for copy 0 the vertices within
/// the band of the lowest), seen along r. Copies are moved by multiples of f_max along r. The tilt about a
/// side of the hull is atan(d / H): d from the side to the centre of mass as seen along r, H from the side up
/// to it; 90 degrees where it hangs below.
///
/// Contacts count as supports on slopes as well, as if they did not slide. Components of a closed surface are
/// bodies; those inside the box of a larger one and turned against it are cavities. Double precision. Throws
/// UsageError for options out of range, InputError when `validate(shape)` fails, the shape has no area, or
/// its copies pass each other along r.
StaticStability static_stability(const Shape& shape, const Direction& direction,
                                 const StaticStabilityOptions& options = {});

}  // namespace stackabilization
