#pragma once

#include <filesystem>
#include <string>
#include <string_view>

namespace stackabilization::experiments {

/// FNV-1a 64-bit hash, 16 hexadecimal digits.
std::string text_hash(std::string_view bytes);

/// The same of a file's bytes. Throws InputError when it cannot be read.
std::string file_hash(const std::filesystem::path& path);

}  // namespace stackabilization::experiments
