#pragma once

#include <optional>
#include <string>

#include "accuracy/sampling.h"
#include "stackabilization/envelope/separation.h"

namespace stackabilization::experiments {

/// Why a sampled f_max differs from the exact one.
struct Shortfall {
  /// "none": it does not, to the precision of a depth buffer. Too large: "wall" - a sample fell on a wall
  /// parallel to r, which the solid semantics pass over; "card" - the graphics card moved the corners of a
  /// steep triangle. Too small, because no sample met what lies higher: "sliver" - it is narrower than a
  /// 32nd of a pixel; "thin part" - its sides are walls, of a rise over run above 4; "slope" - the gap rises
  /// to it gently between samples; "framing" - the same number of samples, put where the shape is, halves the
  /// error.
  std::string reason;
  /// Of what was missed, pixels: its area over its length; 0 for a sliver, empty when nothing was missed.
  std::optional<double> width;
};

/// `solid` and `closed` are the exact answers along `direction`.
Shortfall shortfall(const Shape& shape, const Direction& direction, const Sampling& sampling,
                    const Separation& solid, const Separation& closed);

}  // namespace stackabilization::experiments
