#include "stackabilization/shape/part_names.h"

#include <algorithm>

#include "stackabilization/shape/errors.h"

namespace stackabilization {

std::vector<int> parts_named(const Shape& shape, const std::vector<std::string>& names) {
  const std::vector<std::string>& known = shape.part_names;
  std::vector<int> parts;
  for (const std::string& name : names) {
    const auto found = std::find(known.begin(), known.end(), name);
    if (found == known.end()) throw InputError("there is no part '" + name + "'");
    parts.push_back(static_cast<int>(found - known.begin()));
  }
  std::sort(parts.begin(), parts.end());
  parts.erase(std::unique(parts.begin(), parts.end()), parts.end());
  return parts;
}

}  // namespace stackabilization
