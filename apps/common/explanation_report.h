#pragma once

#include <string>
#include <vector>

#include "apps/common/json.h"
#include "stackabilization/improvement/explanation.h"

namespace stackabilization::apps {

/// {lines, groups}: what is shown, and every group with its numbers.
Json explanation_json(const Explanation& explanation, const std::vector<std::string>& part_names);
/// The lines, or one that says that there is nothing to be seen.
std::vector<std::string> explanation_lines(const Explanation& explanation, std::size_t max_lines = 6);

}  // namespace stackabilization::apps
