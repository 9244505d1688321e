#pragma once

#include <string_view>

namespace stackabilization {

/// Is it UTF-8, as RFC 3629 has it: no stray or missing bytes, no overlong forms, no surrogates?
bool is_utf8(std::string_view text);

}  // namespace stackabilization
