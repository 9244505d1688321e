#pragma once

#include <string>
#include <vector>

#include "stackabilization/core/shape.h"

namespace stackabilization {

/// Rows of the parts with these names, ascending, each once. Throws InputError with the words of
/// `unknown_part` for the first name that no part has.
std::vector<int> parts_named(const Shape& shape, const std::vector<std::string>& names);

/// A clause that says that there is no part `name`, and which parts there are: those with the nearest names
/// first, 12 at most, and how many more. Where parts were only numbered (part_1, part_2, ...) it says how to
/// see which is which.
std::string unknown_part(const std::vector<std::string>& part_names, const std::string& name);

}  // namespace stackabilization
