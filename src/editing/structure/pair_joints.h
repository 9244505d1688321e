#pragma once

#include <vector>

#include "stackabilization/structure/structure.h"

namespace stackabilization::editing {

/// Says whether a relation is a point joint or a line joint.
bool is_joint(const Relation& relation);

/// Returns joints of two parts where their surfaces come nearest: those that `find_joints` finds with the
/// smallest reach, doubled from its default, that finds any. Throws UsageError when the parts are one, are
/// joined already, or are further apart than a quarter of the smallest ball around both.
std::vector<Relation> joints_between(const StructuredShape& structured, int first, int second);

}  // namespace stackabilization::editing
