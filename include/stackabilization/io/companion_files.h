#pragma once

#include <filesystem>
#include <optional>
#include <vector>

#include "stackabilization/io/format.h"

namespace stackabilization {

/// Returns the files that a mesh file refers to: buffers and images of glTF, material libraries of OBJ.
/// `format` is the format of the file when the extension does not name it. The function does not check
/// whether these files exist. The result is empty for other formats, for standard input and pipes, and for
/// files that cannot be read (reading the mesh then reports the error).
std::vector<std::filesystem::path> companion_files(const std::filesystem::path& mesh,
                                                   std::optional<Format> format = {});

}  // namespace stackabilization
