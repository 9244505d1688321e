#pragma once

#include <string>
#include <string_view>

namespace stackabilization::detail {

/// Returns `reason` with every amount replaced by "...". Amounts are numbers with a decimal point or an
/// exponent.
std::string without_amounts(std::string_view reason);

}  // namespace stackabilization::detail
