#pragma once

#include <cstdint>
#include <vector>

#include "stackabilization/core/shape.h"

/// Not installed.
namespace stackabilization::detail {

struct RodLatticeRule {
  int min_wires = 12;
  double min_share = 0.75;  ///< of the components are wires
  /// A wire has at most this much surface, as a multiple of the square of the diameter of the ball around it:
  /// a straight rod a twentieth as thick as long has 0.157.
  double max_surface = 0.15;
  double min_crossings = 8;  ///< other wires that a wire meets, in the mean
  double reach = 0.01;       ///< wires this near meet, fraction of the diameter of the ball around the shape
};

/// Do the components (a number per triangle, from 0) form a net of wires, as of a basket: nearly all of them
/// thin, and each held by so many others that none can be edited by itself? Decided on samples of the
/// surface, spaced by half of the reach at most. The same in every pose and at every scale, up to rounding.
bool is_rod_lattice(const Shape& shape, const std::vector<std::int32_t>& component,
                    const RodLatticeRule& rule = {});

}  // namespace stackabilization::detail
