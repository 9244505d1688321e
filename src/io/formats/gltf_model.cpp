// tinygltf is compiled here, once. It forgets to include <fstream>.
#include <fstream>
#define TINYGLTF_IMPLEMENTATION
#include <algorithm>
#include <limits>

#include "io/formats/bytes.h"
#include "io/formats/gltf_json.h"
#include "io/formats/gltf_model.h"
#include "io/formats/gltf_numbers.h"
#include "stackabilization/core/errors.h"
#include "stackabilization/io/read_file.h"

namespace stackabilization {

namespace {

using Folder = std::optional<std::filesystem::path>;

/// The same GLB with its JSON padded by spaces to whole words, as the standard asks for and newer versions of
/// tinygltf insist on, but some writers forget.
std::string padded_glb(std::string_view bytes) {
  constexpr std::size_t start = 20;
  const std::size_t json = gltf_json(bytes).size(), missing = (4 - json % 4) % 4;
  std::string padded(bytes.substr(0, 8));
  append_little(padded, static_cast<std::uint32_t>(bytes.size() + missing));
  append_little(padded, static_cast<std::uint32_t>(json + missing));
  padded += bytes.substr(16, start - 16 + json);
  padded.append(missing, ' ');
  padded += bytes.substr(start + json);
  return padded;
}

/// Returns whether the length of the JSON of a GLB is not a multiple of four, so that the data after it are
/// not aligned.
bool needs_padding(std::string_view bytes) {
  constexpr std::size_t start = 20;
  if (!bytes.starts_with("glTF") || bytes.size() < start) return false;
  const std::size_t stated = load<std::uint32_t>(bytes.data() + 12, std::endian::little);
  return stated % 4 != 0 && stated <= bytes.size() - start;
}

/// File access for tinygltf; the user pointer is the folder of the file.
template <class Callbacks>
Callbacks file_callbacks(const Folder& folder) {
  Callbacks callbacks{};
  callbacks.FileExists = [](const std::string& path, void*) {
    return std::filesystem::is_regular_file(path);
  };
  callbacks.ExpandFilePath = [](const std::string& path, void*) { return path; };
  callbacks.ReadWholeFile = [](std::vector<unsigned char>* bytes, std::string* error, const std::string& path,
                               void*) {
    try {
      const std::string text = read_file(path);
      bytes->assign(text.begin(), text.end());
      return true;
    } catch (const InputError& reason) {
      *error += reason.what();
      return false;
    }
  };
  // Newer versions take the callbacks only when all are set.
  callbacks.WriteWholeFile = [](std::string*, const std::string&, const std::vector<unsigned char>&, void*) {
    return false;
  };
  if constexpr (requires { callbacks.GetFileSizeInBytes; })
    callbacks.GetFileSizeInBytes = [](std::size_t* size, std::string*, const std::string& path, void*) {
      std::error_code error;
      *size = static_cast<std::size_t>(std::filesystem::file_size(path, error));
      return !error;
    };
  if (!folder) callbacks.FileExists = [](const std::string&, void*) { return false; };
  return callbacks;
}

/// Returns the error of the JSON reader as a sentence for people.
std::string plain_reason(std::string error) {
  if (error.find("too short") != std::string::npos) return "it is too short";
  if (const std::size_t place = error.find("line "); error.find("json.exception") != std::string::npos)
    return "its JSON is malformed" +
           (place == std::string::npos ? "" : " at " + error.substr(place, error.find(':', place) - place));
  std::replace(error.begin(), error.end(), '\n', ' ');
  error.erase(error.find_last_not_of(' ') + 1);
  return error.empty() ? "it cannot be parsed" : error;
}

}  // namespace

bool is_deeply_nested(std::string_view json) {
  constexpr int deepest = 200;
  int depth = 0;
  bool in_string = false;
  for (std::size_t i = 0; i < json.size(); ++i) {
    const char c = json[i];
    if (in_string && c == '\\') ++i;
    if (c == '"') in_string = !in_string;
    if (in_string) continue;
    if (c == '{' || c == '[') ++depth;
    if (c == '}' || c == ']') --depth;
    if (depth > deepest) return true;
  }
  return false;
}

std::string_view gltf_json(std::string_view bytes) {
  constexpr std::size_t start = 20;
  if (!bytes.starts_with("glTF") || bytes.size() < start) return bytes;
  return bytes.substr(start, load<std::uint32_t>(bytes.data() + 12, std::endian::little));
}

tinygltf::Model parse_gltf(const Source& source, const Folder& folder) {
  if (source.bytes.size() > std::numeric_limits<std::uint32_t>::max())
    throw InputError(source.name + ": glTF files hold at most 4 GiB");
  if (is_deeply_nested(gltf_json(source.bytes)))
    throw InputError(source.name + ": its JSON is nested without end");
  check_gltf_numbers(gltf_json(source.bytes), source.name);
  const std::string padded = needs_padding(source.bytes) ? padded_glb(source.bytes) : "";
  const std::string_view bytes = padded.empty() ? source.bytes : padded;
  tinygltf::TinyGLTF loader;
  loader.SetImageLoader([](tinygltf::Image*, const int, std::string*, std::string*, int, int,
                           const unsigned char*, int, void*) { return true; },
                        nullptr);
  loader.SetFsCallbacks(file_callbacks<tinygltf::FsCallbacks>(folder));
  tinygltf::Model model;
  std::string error;
  std::string warning;
  const std::string base = folder ? folder->string() : "";
  const auto length = static_cast<unsigned>(bytes.size());
  const bool good =
      bytes.starts_with("glTF")
          ? loader.LoadBinaryFromMemory(&model, &error, &warning,
                                        reinterpret_cast<const unsigned char*>(bytes.data()), length, base)
          : loader.LoadASCIIFromString(&model, &error, &warning, bytes.data(), length, base);
  if (good) return model;
  throw InputError(source.name + ": expected a glTF 2.0 file with its buffers: " + plain_reason(error));
}

}  // namespace stackabilization
