#pragma once

// tinygltf without its own image decoders and file access.
#define TINYGLTF_NO_STB_IMAGE
#define TINYGLTF_NO_STB_IMAGE_WRITE
#define TINYGLTF_NO_FS
#include <tiny_gltf.h>

#include <filesystem>
#include <optional>

#include "stackabilization/core/text.h"

namespace stackabilization {

/// Parses a glTF file with its buffers, which may be in `folder`. Images are ignored. Throws InputError.
tinygltf::Model parse_gltf(const Source& source, const std::optional<std::filesystem::path>& folder);

}  // namespace stackabilization
