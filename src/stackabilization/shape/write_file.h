#pragma once

#include <filesystem>
#include <string_view>

namespace stackabilization {

/// Writes `bytes` to a temporary name beside `path` and renames it onto `path`: readers see the old file or
/// the whole new one, with the permissions of the old. `path` "-" writes to standard output; what exists and
/// is no regular file (a pipe, /dev/null) is written directly. Throws OutputError, leaving nothing behind.
void write_file_atomically(const std::filesystem::path& path, std::string_view bytes);

}  // namespace stackabilization
