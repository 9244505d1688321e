#pragma once

#include <string>

#include "stackabilization/structure/structure.h"

namespace stackabilization::detail {

/// Formats a number to three significant digits, for the reasons of refusals.
std::string fraction(double value);

/// Names a relation and its parts, as in "the point_joint of 'leg' and 'seat'".
std::string name_of(const Relation& relation, const Structure& structure);

}  // namespace stackabilization::detail
