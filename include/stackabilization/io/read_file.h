#pragma once

#include <filesystem>
#include <string>

namespace stackabilization {

/// Reads all bytes of a file or pipe; "-" is standard input. Throws InputError, naming the path, when it is
/// missing, a folder or unreadable.
std::string read_file(const std::filesystem::path& path);

}  // namespace stackabilization
