#pragma once

#include <string>

#include "stackabilization/structure/structure.h"

namespace stackabilization::detail {

/// Three digits, for the reasons of refusals.
std::string fraction(double value);

/// "the point_joint of 'leg' and 'seat'".
std::string name_of(const Relation& relation, const Structure& structure);

}  // namespace stackabilization::detail
