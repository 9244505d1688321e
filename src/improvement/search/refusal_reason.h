#pragma once

#include <string>
#include <string_view>

namespace stackabilization::detail {

/// A reason with "..." for its amounts: for every number with a fraction or an exponent.
std::string without_amounts(std::string_view reason);

}  // namespace stackabilization::detail
