#pragma once

#include <nlohmann/json.hpp>

namespace stackabilization::experiments {

/// Objects keep the order in which they are filled.
using Json = nlohmann::ordered_json;

}  // namespace stackabilization::experiments
