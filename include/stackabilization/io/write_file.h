#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace stackabilization {

/// Writes `bytes` to a temporary name beside `path` and renames it to `path`. Readers see the old file or the
/// complete new file, with the permissions of the old one. `path` "-" writes to standard output. An existing
/// path that is not a regular file (a pipe, /dev/null) is written directly. A symbolic link stays; its target
/// is written, whether it exists or not. Other hard links to the file keep the old content. Throws
/// OutputError and removes the temporary file.
///
/// The temporary name is PATH.PROCESS.tmp. A process that is killed while writing leaves this file; the next
/// write to the same path removes it.
void write_file_atomically(const std::filesystem::path& path, std::string_view bytes);

/// Returns the target name of a temporary name of `write_file_atomically`: "a.obj" for "a.obj.4711.tmp".
/// Returns nothing for other names.
std::optional<std::string> target_of_temporary(std::string_view name);

/// Returns a path, the target of the path when it is a symbolic link, the target of that target, and so on.
/// The last path is not a link and need not exist. When the last path is a link, the links form a cycle.
std::vector<std::filesystem::path> steps_of_links(const std::filesystem::path& path);

}  // namespace stackabilization
