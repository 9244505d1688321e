#include "stackabilization/io/companion_files.h"

#include <charconv>
#include <nlohmann/json.hpp>
#include <string>
#include <string_view>

#include "io/formats/gltf_json.h"
#include "stackabilization/core/errors.h"
#include "stackabilization/core/text.h"
#include "stackabilization/io/read_file.h"

namespace stackabilization {

namespace {

using Names = std::vector<std::string>;

/// "a b" for "a%20b".
std::string decoded(std::string_view uri) {
  std::string text;
  for (std::size_t i = 0; i < uri.size(); ++i) {
    unsigned char byte = 0;
    const char* const digits = uri.data() + i + 1;
    if (uri[i] == '%' && i + 2 < uri.size() &&
        std::from_chars(digits, digits + 2, byte, 16).ptr == digits + 2) {
      text += static_cast<char>(byte);
      i += 2;
    } else {
      text += uri[i];
    }
  }
  return text;
}

Names gltf_companions(std::string_view bytes) {
  const std::string_view text = gltf_json(bytes);
  if (is_deeply_nested(text)) return {};
  const nlohmann::json document = nlohmann::json::parse(text, nullptr, false);
  Names names;
  for (const char* list : {"buffers", "images"}) {
    if (!document.is_object() || !document.contains(list) || !document.at(list).is_array()) continue;
    for (const nlohmann::json& entry : document.at(list)) {
      if (!entry.is_object() || !entry.contains("uri") || !entry.at("uri").is_string()) continue;
      const auto uri = entry.at("uri").get<std::string>();
      if (!uri.starts_with("data:")) names.push_back(decoded(uri));
    }
  }
  return names;
}

Names obj_companions(const Source& source) {
  constexpr std::string_view keyword = "mtllib";
  if (source.bytes.find(keyword) == std::string_view::npos) return {};
  Names names;
  for (TextCursor cursor(source); cursor.next_line();) {
    if (cursor.token() != keyword) continue;
    const std::string all = cursor.rest_of_line();
    names.push_back(all);  // a name with blanks, or a list of names
    for (std::size_t start = 0, end = 0; end != std::string::npos; start = end + 1) {
      end = all.find(' ', start);
      names.push_back(all.substr(start, end - start));
    }
  }
  return names;
}

std::optional<Format> format_of(const std::filesystem::path& mesh, std::optional<Format> format) {
  try {
    return format ? format : std::optional(format_of_extension(mesh));
  } catch (const InputError&) {
    return std::nullopt;
  }
}

}  // namespace

std::vector<std::filesystem::path> companion_files(const std::filesystem::path& mesh,
                                                   std::optional<Format> format) {
  format = format_of(mesh, format);
  std::error_code error;
  if ((format != Format::gltf && format != Format::obj) || !std::filesystem::is_regular_file(mesh, error))
    return {};
  Names names;
  try {
    const std::string name = mesh.string(), bytes = read_file(mesh);
    names = format == Format::gltf ? gltf_companions(bytes) : obj_companions({bytes, name});
  } catch (const InputError&) {
    return {};
  }
  std::vector<std::filesystem::path> files;
  for (const std::string& name : names)
    if (!name.empty()) files.push_back(mesh.parent_path() / name);
  return files;
}

}  // namespace stackabilization
