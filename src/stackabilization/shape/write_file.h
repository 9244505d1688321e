#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <string_view>

namespace stackabilization {

/// Writes `bytes` to a temporary name beside `path` and renames it onto `path`: readers see the old file or
/// the whole new one, with the permissions of the old. `path` "-" writes to standard output; what exists and
/// is no regular file (a pipe, /dev/null) is written directly. Throws OutputError, leaving nothing behind.
///
/// The temporary name is PATH.PROCESS.tmp. A process that is killed while it writes leaves that file; the
/// next one that writes the same path removes it.
void write_file_atomically(const std::filesystem::path& path, std::string_view bytes);

/// "a.obj" for the name "a.obj.4711.tmp", under which `write_file_atomically` writes; nothing for others.
std::optional<std::string> target_of_temporary(std::string_view name);

}  // namespace stackabilization
