#pragma once

#include <Eigen/Core>
#include <optional>
#include <vector>

#include "stackabilization/stacking/stackability.h"

/// Not installed.
namespace stackabilization::detail {

/// S in the best of the directions (among equals the first); nothing when the shape has no volume, so that S
/// is undefined. Throws UsageError without directions.
std::optional<Stackability> best_measured(const Shape& shape, StackabilityOptions options,
                                          const std::vector<Eigen::Vector3d>& directions);

}  // namespace stackabilization::detail
