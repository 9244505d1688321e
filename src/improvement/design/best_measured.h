#pragma once

#include <Eigen/Core>
#include <optional>
#include <vector>

#include "stackabilization/stacking/stackability.h"

// The best of several stacking directions of one shape.
namespace stackabilization::detail {

/// Returns S and its terms along the direction of largest S (ties: the first). Nothing when the shape has no
/// volume, since S is then undefined. Throws UsageError without directions.
std::optional<Stackability> best_measured(const Shape& shape, StackabilityOptions options,
                                          const std::vector<Eigen::Vector3d>& directions);

}  // namespace stackabilization::detail
