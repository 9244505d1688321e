#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace stackabilization {

/// Writes `bytes` to a temporary name beside `path` and renames it onto `path`: readers see the old file or
/// the whole new one, with the permissions of the old. `path` "-" writes to standard output; what exists and
/// is no regular file (a pipe, /dev/null) is written directly. A symbolic link stays: what it leads to is
/// written, be it there or not. Other names of the same file (hard links) keep what they had. Throws
/// OutputError, leaving nothing behind.
///
/// The temporary name is PATH.PROCESS.tmp. A process that is killed while it writes leaves that file; the
/// next one that writes the same path removes it.
void write_file_atomically(const std::filesystem::path& path, std::string_view bytes);

/// "a.obj" for the name "a.obj.4711.tmp", under which `write_file_atomically` writes; nothing for others.
std::optional<std::string> target_of_temporary(std::string_view name);

/// A path, what it leads to if it is a symbolic link, what that leads to, and so on; the last one is no link,
/// and need not be there. One that is a link means that the links lead in a circle.
std::vector<std::filesystem::path> steps_of_links(const std::filesystem::path& path);

}  // namespace stackabilization
