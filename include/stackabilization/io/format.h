#pragma once

#include <filesystem>
#include <optional>
#include <string_view>

namespace stackabilization {

/// Mesh file format. `gltf` is read as text (.gltf) or binary (.glb) and written as binary. `vtp` is only
/// written.
enum class Format { obj, off, ply, stl, three_mf, gltf, vtp };

/// Returns the format of the extension of `path`, in upper or lower case. Throws InputError, naming the
/// supported extensions, for any other extension.
Format format_of_extension(const std::filesystem::path& path);

/// Returns the format that the first bytes of a file identify, or nothing. Binary STL has no signature and is
/// identified by its size. OBJ is identified by its first keyword.
std::optional<Format> sniff_format(std::string_view bytes);

/// Returns the extensions of the formats that can be read, for messages and help texts: ".obj, .off, .ply,
/// .stl, .3mf, .gltf, .glb".
std::string_view readable_extensions();
/// Returns the extensions of the formats that can be written; they include ".vtp".
std::string_view writable_extensions();

}  // namespace stackabilization
