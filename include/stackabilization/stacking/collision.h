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

/// Limit of the number of nearby pairs of triangles that a collision test examines.
inline constexpr std::int64_t max_collision_pairs = 5'000'000;

/// Reason why winding numbers do not define the interior of a shape.
enum class InteriorDefect {
  open,        ///< the shape is open or non-manifold and has no winding numbers
  inside_out,  ///< there are winding numbers of both signs: some parts are inside out
  undecided,   ///< not examined: more than `max_collision_pairs` pairs of triangles lie above each other
  no_volume,   ///< surfaces cancel each other, as in a box without thickness, and enclose nothing
};

/// Collision tests between a fixed shape and a lifted shape. They are exact for the given coordinates and any
/// rational lift: the lifted coordinates p + t r are never rounded. The tests compare triangles and share no
/// code with the separation queries. A CGAL AABB tree finds candidates, CGAL predicates over rationals
/// decide.
///
/// Triangles without area never touch or cross anything. Triangles in the same place with the same neighbours
/// count once.
///
/// Built once per pair of shapes and queried for any number of directions and lifts, also by several threads
/// at a time. A query runs in parallel and is deterministic.
class CollisionTester {
 public:
  /// Throws InputError unless `validate` passes for both shapes.
  CollisionTester(const Shape& below, const Shape& above);
  CollisionTester(CollisionTester&&) noexcept;
  CollisionTester& operator=(CollisionTester&&) noexcept;
  ~CollisionTester();

  const Shape& below() const;  ///< the fixed shape
  const Shape& above() const;  ///< the lifted shape

  /// Returns whether both shapes are closed surfaces: every edge is traversed once in each direction. Edges
  /// are identified by the indices of the shape, otherwise by equal coordinates, otherwise by equal
  /// coordinates within each part.
  bool solids() const;

  /// Returns whether `below` and `above` + lift * r have a common point. Throws InputError when the boxes of
  /// more than `max_collision_pairs` pairs of triangles intersect at this lift.
  bool closed_contact(const Direction& direction, const Rational& lift) const;

  /// Returns the reason why `interiors_overlap` is not exact for these shapes, or nothing when it is exact.
  /// The function computes winding numbers on both sides of one point of every triangle. A shape that is
  /// inside out as a whole has no defect.
  std::optional<InteriorDefect> interior_defect() const;

  /// Returns whether the interiors of `below` and `above` + lift * r have a common point, that is, whether
  /// the regularised intersection is not empty. The interior of a shape is the set of points with non-zero
  /// winding number. Parts may overlap and have cavities. The result is exact unless `interior_defect` names
  /// a defect. Throws InputError unless `solids()`, and as `closed_contact` does.
  bool interiors_overlap(const Direction& direction, const Rational& lift) const;

 private:
  struct Data;
  std::unique_ptr<const Data> data_;
};

/// Runs `CollisionTester::closed_contact` once.
bool closed_contact(const Shape& below, const Shape& above, const Direction& direction, const Rational& lift);

/// Runs `CollisionTester::interiors_overlap` once.
bool interiors_overlap(const Shape& below, const Shape& above, const Direction& direction,
                       const Rational& lift);

/// Options of `translation_by_bisection`.
struct BisectionOptions {
  ContactSemantics semantics =
      ContactSemantics::solid;  ///< `solid` tests interiors (closed shapes only), `closed` any contact
  int steps = 64;               ///< number of equal steps downwards, in [1, 1000000]
  /// Width of the final bracket, fraction of the whole way.
  double relative_width =
      tolerance::relative;  ///< width of the bracket at which to stop, relative to the way
};

/// A free lift and a colliding lift below it, in units of r. Every tested lift above `free` was free as well.
struct CollisionBracket {
  double free = 0;       ///< lift without collision, units of r
  double colliding = 0;  ///< lift with collision, units of r, less than `free`
  int tests = 0;         ///< number of collision tests
};

/// Searches sep(below, above, r) with collision tests only. The search starts where `above` is entirely over
/// `below`, moves down in equal steps to the first collision, and bisects the last step. Returns nothing when
/// no step collides.
///
/// Collision is not monotone in the lift (hooks, wine glasses). Plain bisection finds any change from
/// colliding to free; this search finds the uppermost change of at least a step. It can miss collisions over
/// less than a step. `colliding` of the bracket is therefore a certain lower bound of the separation, but
/// `free` is not an upper bound. The result is a check, not a decision. Throws UsageError for options out of
/// range, and InputError as the tests do.
std::optional<CollisionBracket> translation_by_bisection(const CollisionTester& tester,
                                                         const Direction& direction,
                                                         const BisectionOptions& options = {});

}  // namespace stackabilization
