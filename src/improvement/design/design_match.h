#pragma once

#include <vector>

#include "stackabilization/deformation/deformation_model.h"

namespace stackabilization::detail {

/// Returns the primitives of the parts, in order.
std::vector<Primitive> primitives_of(const Structure& structure);

/// Throws UsageError unless `design` has `vertex_count` vertices and primitives of the same kinds and sizes
/// as `rest`.
void require_match(const Design& design, const std::vector<Primitive>& rest, Eigen::Index vertex_count);

}  // namespace stackabilization::detail
