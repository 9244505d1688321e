#pragma once

#include <string_view>

namespace stackabilization {

/// Returns whether a text is UTF-8 according to RFC 3629: no stray or missing bytes, no overlong forms, no
/// surrogates.
bool is_utf8(std::string_view text);

}  // namespace stackabilization
