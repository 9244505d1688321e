#pragma once

#include <string>
#include <string_view>

namespace stackabilization {

/// Encodes bytes as base64 with padding and without line breaks (RFC 4648, section 4).
std::string base64_text(std::string_view bytes);

/// Compresses bytes to a gzip member (RFC 1952) without name and time: same bytes in, same bytes out.
std::string gzip_bytes(std::string_view bytes);

}  // namespace stackabilization
