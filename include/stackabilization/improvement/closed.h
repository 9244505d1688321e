#pragma once

#include <optional>
#include <string>

#include "stackabilization/stacking/stackability.h"
#include "stackabilization/structure/structure.h"

namespace stackabilization {

/// Two pieces that keep copies from entering each other: copies would have to pass one through the other.
struct ClosedPair {
  int upper_part = -1, lower_part = -1;  ///< parts at the upper and at the lower end of the shape
  double stackability = 0;               ///< S while the two pieces lie above each other, at most
};

/// Returns a pair of pieces, one at the upper end of the shape along `direction` and one at the lower end,
/// that must pass each other before copies reach `target`, and cannot: they overlap as seen along the
/// direction after every move across it by up to tolerance::closed_move of the diagonal, and after scalings
/// of both, about their own middle or that of the shape, by up to tolerance::closed_scale, one up and one
/// down. Then the height, and the sizes of parts, would have to change by more than a person would call the
/// same object. Nothing when there is no such pair: it says nothing about whether the target can be reached.
/// A heuristic on a grid of pixels, with bounded work. `measured`: stackability of the shape along the
/// direction.
std::optional<ClosedPair> closed_pair(const Shape& shape, const Direction& direction,
                                      const Stackability& measured, double target);

/// Returns the pair as a sentence: "Closed: 'top' at the top of each copy lies under 'foot' at the bottom of
/// ...".
std::string describe(const ClosedPair& pair, const Structure& rest);

}  // namespace stackabilization
