#pragma once

#include <filesystem>
#include <optional>
#include <string_view>

namespace stackabilization {

/// Mesh file formats. `vtp` is only written; `gltf` is read as text (.gltf) or binary (.glb) and written as
/// binary.
enum class Format { obj, off, ply, stl, three_mf, gltf, vtp };

/// Format that the extension of `path` names, in either case. Throws InputError naming the supported
/// extensions.
Format format_of_extension(const std::filesystem::path& path);

/// Format that the first bytes of a file give away, or nothing. Binary STL has no signature and is recognised
/// by its size; OBJ by its first keyword.
std::optional<Format> sniff_format(std::string_view bytes);

/// ".obj, .off, .ply, .stl, .3mf, .gltf, .glb" and so on, for messages and help texts.
std::string_view readable_extensions();
/// The same for formats that can be written, ".vtp" among them.
std::string_view writable_extensions();

}  // namespace stackabilization
