#pragma once

#include <vector>

#include "stackabilization/envelope/contacts.h"
#include "stackabilization/envelope/separation_tree.h"

namespace stackabilization::detail {

/// Every polygon over which f >= floor, one per pair of triangles, in the order of the pairs (upper, lower).
/// `floor` is a length in units of r. In solid semantics, pairs whose
/// projections only touch have none.
std::vector<ContactPolygon> contact_polygons(const SeparationTree::Data& tree, const Direction& direction,
                                             Semantics semantics, double floor);

}  // namespace stackabilization::detail
