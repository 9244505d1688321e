#include <string>

#include "stackabilization/core/errors.h"
#include "stackabilization/stacking/collision.h"

namespace stackabilization {

namespace {

/// Range of lifts, in units of r, at which the shapes can meet.
Range possible_lifts(const Shape& below, const Shape& above, const Direction& direction) {
  const Range below_range = range_along(below, direction.vector());
  const Range above_range = range_along(above, direction.vector());
  const double squared = direction.vector().squaredNorm();
  return {(below_range.low - above_range.high) / squared, (below_range.high - above_range.low) / squared};
}

}  // namespace

std::optional<CollisionBracket> translation_by_bisection(const CollisionTester& tester,
                                                         const Direction& direction,
                                                         const BisectionOptions& options) {
  constexpr int max_steps = 1'000'000;
  if (options.steps < 1 || options.steps > max_steps)
    throw UsageError("a search by collision tests takes 1 to " + std::to_string(max_steps) + " steps");
  if (!(options.relative_width > 0 && options.relative_width < 1))
    throw UsageError("the relative width of a bracket lies between 0 and 1");

  const auto [lowest, highest] = possible_lifts(tester.below(), tester.above(), direction);
  const double way = highest - lowest, step = way / options.steps;
  CollisionBracket bracket;
  const auto collides = [&](double lift) {
    ++bracket.tests;
    return options.semantics == ContactSemantics::closed
               ? tester.closed_contact(direction, Rational(lift))
               : tester.interiors_overlap(direction, Rational(lift));
  };
  // Steps fall between the multiples of the way, where regular models touch; the first one is free in any
  // semantics.
  bracket.free = highest + step / 2;
  for (int k = 0;; ++k) {
    if (k == options.steps + 1) return std::nullopt;
    bracket.colliding = highest + step / 2 - (k + 1) * step;
    if (collides(bracket.colliding)) break;
    bracket.free = bracket.colliding;
  }
  while (bracket.free - bracket.colliding > options.relative_width * way) {
    const double middle = bracket.colliding + (bracket.free - bracket.colliding) / 2;
    if (middle <= bracket.colliding || middle >= bracket.free) break;
    (collides(middle) ? bracket.colliding : bracket.free) = middle;
  }
  return bracket;
}

}  // namespace stackabilization
