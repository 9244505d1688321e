#pragma once

#include <string>
#include <vector>

#include "stackabilization/shape/shape.h"

namespace stackabilization {

/// Rows of the parts with these names, ascending, each once. Throws InputError naming the first name that no
/// part has.
std::vector<int> parts_named(const Shape& shape, const std::vector<std::string>& names);

}  // namespace stackabilization
