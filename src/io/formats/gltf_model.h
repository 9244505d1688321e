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

/// The parsed file with its buffers, which may lie in `folder`; images are left alone. Throws InputError.
tinygltf::Model parse_gltf(const Source& source, const std::optional<std::filesystem::path>& folder);

}  // namespace stackabilization
