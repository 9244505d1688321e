#pragma once

#include <vector>

#include "stackabilization/improvement/design.h"

namespace stackabilization::detail {

std::vector<Primitive> primitives_of(const Structure& structure);

/// Throws UsageError unless `design` has so many vertices and primitives of the kinds and sizes of these.
void require_match(const Design& design, const std::vector<Primitive>& rest, Eigen::Index vertex_count);

}  // namespace stackabilization::detail
