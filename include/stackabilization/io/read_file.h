#pragma once

#include <filesystem>
#include <string>

namespace stackabilization {

/// All bytes of a file, pipe or, for "-", standard input. Throws InputError naming the path when it is
/// missing, a folder, or unreadable.
std::string read_file(const std::filesystem::path& path);

}  // namespace stackabilization
