#pragma once

#include <vector>

#include "stackabilization/structure/structure.h"

namespace stackabilization::editing {

/// Returns joints of two parts where their surfaces come nearest: those that `find_joints` finds with the
/// smallest reach, doubled from its default, that finds any. Throws UsageError when the parts are one, are
/// joined already, or are further apart than a quarter of the smallest ball around both.
std::vector<Relation> joints_between(const StructuredShape& structured, int first, int second);

/// Returns the symmetry of two parts that are mirror images of each other: in a plane of symmetry of the
/// whole shape where one maps the parts to each other, else in one of both parts alone. Their surfaces may be
/// off by 3 % of the diagonal of both (SymmetryOptions::tolerance). Throws UsageError when the parts are one,
/// are symmetric already, or are no mirror images.
Relation symmetry_between(const StructuredShape& structured, int first, int second);

}  // namespace stackabilization::editing
