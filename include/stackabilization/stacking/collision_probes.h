#pragma once

#include <string>
#include <vector>

#include "stackabilization/core/direction.h"
#include "stackabilization/core/rational.h"
#include "stackabilization/core/shape.h"
#include "stackabilization/envelope/separation.h"
#include "stackabilization/stacking/collision.h"
#include "stackabilization/stacking/tolerances.h"

namespace stackabilization {

/// Lift of a collision test relative to f_max.
enum class ProbePlace { above, at, below };

/// Returns "above", "at" or "below".
std::string to_string(ProbePlace place);

/// A collision test of two copies whose outcome follows from an exact f_max.
struct CollisionProbe {
  ProbePlace place = ProbePlace::at;                     ///< lift relative to f_max
  ContactSemantics semantics = ContactSemantics::solid;  ///< `solid` tests interiors, `closed` any contact
  Rational lift;                                         ///< lift of the upper copy, units of r
  bool collides = false;                                 ///< the outcome that follows
};

/// Options of `collision_probes`.
struct CollisionProbeOptions {
  ContactSemantics semantics = ContactSemantics::solid;  ///< semantics of f_max
  /// Distance of the places above and below f_max from it, > 0: fraction of the extent h along r, or of the
  /// width across r when h is 0.
  double margin = tolerance::collision_margin;
};

/// Returns the collision tests around `f_max`, the exact separation of two copies of `shape` along
/// `direction`, highest lift first; none if nothing is in the way. Copies must be
///
/// * free above f_max;
/// * in `solid` semantics free at f_max, and, unless the shape has no volume, colliding below it;
/// * in `closed` semantics colliding at f_max, if both triangles of the witness have area: collision tests
///   pass over triangles without area. Below f_max they may be free again where a sheet ends.
///
/// Throws UsageError for a margin that is not positive.
std::vector<CollisionProbe> collision_probes(const Shape& shape, const Direction& direction,
                                             const Separation& f_max,
                                             const CollisionProbeOptions& options = {});

/// Runs the test of a probe. Returns whether the copies collide. Throws as the tests of `tester` do.
bool collides(const CollisionTester& tester, const Direction& direction, const CollisionProbe& probe);

}  // namespace stackabilization
