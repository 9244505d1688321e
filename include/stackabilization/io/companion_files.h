#pragma once

#include <filesystem>
#include <optional>
#include <vector>

#include "stackabilization/io/format.h"

namespace stackabilization {

/// Files that a mesh file refers to: buffers and images of glTF, material libraries of OBJ. `format` is that
/// of the file where its extension does not say. None for other formats, standard input, pipes, and files
/// that cannot be read, which reading the mesh will tell. Whether the files exist is not asked.
std::vector<std::filesystem::path> companion_files(const std::filesystem::path& mesh,
                                                   std::optional<Format> format = {});

}  // namespace stackabilization
