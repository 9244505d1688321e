#pragma once

#include <Eigen/Core>
#include <vector>

#include "stackabilization/stacking/direction_region.h"
#include "stackabilization/stacking/search.h"

namespace stackabilization::detail {

/// A direction to try, with the normal of the great circle it was taken from, or zero.
struct DirectionTrial {
  Eigen::Vector3d direction, circle_normal;
};

/// Returns the directions of `region` that a search tries first: the axis of the cone, the candidates of the
/// options and of the shape, even samples `spacing` radians apart, and samples twice as dense on the great
/// circles across the main candidates. In a plane, the directions that belong to the candidates take the
/// place of the circles. Throws UsageError if the region is empty.
std::vector<DirectionTrial> even_trials(const StackabilitySolver& solver, const SearchOptions& options,
                                        const DirectionRegion& region, double spacing);

}  // namespace stackabilization::detail
