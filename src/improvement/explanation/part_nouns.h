#pragma once

#include <string>
#include <vector>

#include "improvement/explanation/part_changes.h"
#include "stackabilization/structure/structure.h"

namespace stackabilization::detail {

/// Returns what a person calls each part by its form and place. The upright generalized cylinder that has
/// half of the surface or more is the "body"; what is joined to it alone, at two places or more and off the
/// ground, is a "handle"; uprights on the ground are each a "leg", if there are three or more; others have
/// the noun of their form.
std::vector<std::string> part_nouns(const StructuredShape& rest, const std::vector<PartAtRest>& parts,
                                    const ObjectFrame& frame);

}  // namespace stackabilization::detail
