#include "stackabilization/io/format.h"

#include <array>
#include <string>

#include "io/formats/formats.h"
#include "stackabilization/core/errors.h"

namespace stackabilization {

Format format_of_extension(const std::filesystem::path& path) {
  struct Extension {
    std::string_view text;
    Format format;
  };
  static constexpr std::array<Extension, 8> extensions = {{{".obj", Format::obj},
                                                           {".off", Format::off},
                                                           {".ply", Format::ply},
                                                           {".stl", Format::stl},
                                                           {".3mf", Format::three_mf},
                                                           {".gltf", Format::gltf},
                                                           {".glb", Format::gltf},
                                                           {".vtp", Format::vtp}}};
  const std::string found = lower_case(path.extension().string());
  for (const Extension& extension : extensions)
    if (extension.text == found) return extension.format;
  throw InputError(path.string() +
                   ": expected a file name ending in .obj, .off, .ply, .stl, .3mf, .gltf, .glb or " +
                   "(written only) .vtp, found " + (found.empty() ? "no extension" : in_quotes(found)));
}

std::optional<Format> sniff_format(std::string_view bytes) {
  if (bytes.starts_with("PK\x03\x04")) return Format::three_mf;
  if (bytes.starts_with("glTF")) return Format::gltf;
  if (is_binary_stl(bytes)) return Format::stl;
  const std::string name;
  TextCursor cursor({bytes, name});
  if (!cursor.next_content_line()) return bytes.starts_with("#") ? std::optional(Format::obj) : std::nullopt;
  const std::string_view keyword = cursor.token();
  if (keyword == "ply") return Format::ply;
  if (keyword == "solid") return Format::stl;
  if (keyword.ends_with("OFF")) return Format::off;
  if (keyword.starts_with("{")) return Format::gltf;
  for (const std::string_view obj : {"v", "vn", "vt", "g", "o", "f", "s", "l", "p", "mtllib", "usemtl"})
    if (keyword == obj) return Format::obj;
  return std::nullopt;
}

std::string_view readable_extensions() {
  return ".obj, .off, .ply, .stl, .3mf, .gltf, .glb";
}
std::string_view writable_extensions() {
  return ".obj, .off, .ply, .stl, .3mf, .glb, .vtp";
}

}  // namespace stackabilization
