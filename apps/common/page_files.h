#pragma once

#include <optional>
#include <string>
#include <string_view>

namespace stackabilization::apps {

/// A file of the page, embedded in the program.
struct PageFile {
  std::string_view bytes;
  std::string type;  ///< for HTTP
};

/// Returns the file of this path, such as "index.html" or "three/three.module.js"; nothing for other paths.
std::optional<PageFile> page_file(std::string_view path);

}  // namespace stackabilization::apps
