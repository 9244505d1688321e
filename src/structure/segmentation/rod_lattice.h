#pragma once

#include <cstdint>
#include <vector>

#include "stackabilization/core/shape.h"

namespace stackabilization::detail {

/// Thresholds of `is_rod_lattice`.
struct RodLatticeRule {
  int min_wires = 12;       ///< smallest number of wires
  double min_share = 0.75;  ///< smallest share of wires among the components
  /// Largest surface area of a wire, as a multiple of the squared diameter of the smallest ball around it. A
  /// straight rod with a thickness of a twentieth of its length has 0.157.
  double max_surface = 0.15;
  double min_crossings = 8;  ///< smallest mean number of other wires that a wire meets
  /// Largest distance between wires that meet, fraction of the diameter of the smallest ball around the
  /// shape.
  double reach = 0.01;
};

/// Returns whether the components form a net of wires, such as a basket: nearly all of them are thin, and
/// each meets so many others that none can be edited separately. `component`: component of each triangle,
/// from 0. The decision uses samples of the surface at most half of the reach apart. It is the same in every
/// pose and at every scale, up to rounding.
bool is_rod_lattice(const Shape& shape, const std::vector<std::int32_t>& component,
                    const RodLatticeRule& rule = {});

}  // namespace stackabilization::detail
