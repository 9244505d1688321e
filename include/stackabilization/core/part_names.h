#pragma once

#include <string>
#include <vector>

#include "stackabilization/core/shape.h"

namespace stackabilization {

/// Returns the name of member `number` of a part that was cut into members: "NAME.NUMBER".
std::string member_name(const std::string& part, int number);

/// Returns the rows of the parts with these names, ascending, each once. The name of a part that was cut into
/// members stands for all of them. Throws InputError with the text of
/// `unknown_part` for the first name that does not exist.
std::vector<int> parts_named(const Shape& shape, const std::vector<std::string>& names);

/// Returns a clause that says that there is no part `name` and lists the existing parts: at most 12, nearest
/// names first, and the number of the others. For parts with generated names (part_1, part_2, ...) it also
/// tells how to identify them.
std::string unknown_part(const std::vector<std::string>& part_names, const std::string& name);

}  // namespace stackabilization
