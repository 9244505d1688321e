#pragma once

#include <cstdint>
#include <memory>
#include <optional>

#include "stackabilization/core/direction.h"
#include "stackabilization/core/rational.h"
#include "stackabilization/core/shape.h"
#include "stackabilization/core/tolerances.h"
#include "stackabilization/envelope/separation.h"

namespace stackabilization {

/// Most pairs of triangles near each other that a collision test looks at.
inline constexpr std::int64_t max_collision_pairs = 5'000'000;

/// Why the interior of a shape cannot be told by winding numbers.
enum class InteriorDefect {
  open,        ///< it is open or non-manifold: there are no winding numbers
  inside_out,  ///< winding numbers of both signs: some of its parts are inside out
  undecided,   ///< more than `max_collision_pairs` pairs of triangles lie above each other: not looked for
  no_volume,   ///< surfaces that cancel each other, as of a box without thickness: nothing is inside them
};

/// Collision tests between a fixed shape and a lifted one, exact for the coordinates as given and any
/// rational lift: the lifted coordinates p + t r are never rounded. Triangle-triangle tests, sharing nothing
/// with the separation code (CGAL AABB tree for the candidates, CGAL predicates over rationals for the
/// decisions).
///
/// Triangles without area are passed over: only triangles with area touch or cross. Triangles in the same
/// place with the same neighbours count once.
///
/// Built once per pair, queried for any number of directions and lifts, also by several threads at a time. A
/// query runs in parallel and is deterministic.
class CollisionTester {
 public:
  /// Throws InputError unless `validate` passes for both.
  CollisionTester(const Shape& below, const Shape& above);
  CollisionTester(CollisionTester&&) noexcept;
  CollisionTester& operator=(CollisionTester&&) noexcept;
  ~CollisionTester();

  const Shape& below() const;  ///< the fixed shape
  const Shape& above() const;  ///< the shape that is lifted

  /// Are both shapes closed surfaces: is every edge run through once in each direction? (Edges by the shape's
  /// indices, else by equal coordinates, else by equal coordinates within each part.)
  bool solids() const;

  /// Do `below` and `above` + lift * r have a point in common? Throws InputError where the boxes of more than
  /// `max_collision_pairs` pairs of triangles meet at this lift.
  bool closed_contact(const Direction& direction, const Rational& lift) const;

  /// Why `interiors_overlap` is no answer for these shapes; nothing when it is exact. Looks at winding
  /// numbers beside one point of every triangle; a shape that is inside out as a whole is no defect.
  std::optional<InteriorDefect> interior_defect() const;

  /// Do the interiors of `below` and `above` + lift * r have a point in common: is the regularised
  /// intersection not empty? The interior of a shape is where its winding number is not zero; the answer is
  /// exact when neither shape has winding numbers of both signs or surfaces that cancel each other (see
  /// `interior_defect`; parts may overlap and have cavities). Throws InputError unless `solids()`,
  /// and as `closed_contact`.
  bool interiors_overlap(const Direction& direction, const Rational& lift) const;

 private:
  struct Data;
  std::unique_ptr<const Data> data_;
};

/// `CollisionTester::closed_contact` for one use.
bool closed_contact(const Shape& below, const Shape& above, const Direction& direction, const Rational& lift);

/// `CollisionTester::interiors_overlap` for one use.
bool interiors_overlap(const Shape& below, const Shape& above, const Direction& direction,
                       const Rational& lift);

/// How `translation_by_bisection` walks down.
struct BisectionOptions {
  ContactSemantics semantics =
      ContactSemantics::solid;  ///< `solid` tests interiors (closed shapes only), `closed` any contact
  int steps = 64;               ///< lifts tried on the way down from the top, in [1, 1000000]
  double relative_width =
      tolerance::relative;  ///< width of the bracket at which to stop, relative to the way
};

/// A free lift and a colliding one below it, in units of r: every lift tried above `free` was free as well.
struct CollisionBracket {
  double free = 0;       ///< lift without a collision, units of r
  double colliding = 0;  ///< lift with one, units of r, less than `free`
  int tests = 0;         ///< collision tests made
};

/// Looks for sep(below, above, r) with collision tests only, in the direction that a copy comes from: starts
/// where `above` is entirely over `below`, walks down in equal steps to the first collision and bisects the
/// last step. Nothing when no step collides.
///
/// Collision is not monotone in the lift (hooks, wine glasses), so plain bisection finds some change from
/// colliding to free; this search finds the uppermost one wider than a step. Collisions over less than a step
/// can be missed: the bracket's `colliding` is a certain lower bound of the separation, its `free` is not an
/// upper bound. A check, not a decision. Throws UsageError for impossible options, InputError as the tests
/// do.
std::optional<CollisionBracket> translation_by_bisection(const CollisionTester& tester,
                                                         const Direction& direction,
                                                         const BisectionOptions& options = {});

}  // namespace stackabilization
