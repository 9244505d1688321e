#pragma once

#include <string_view>
#include <vector>

namespace stackabilization::apps {

struct EmbeddedFile {
  std::string_view path, bytes;
};

/// The files that the build embeds (cmake/StackabilizationEmbed.cmake).
const std::vector<EmbeddedFile>& embedded_files();

}  // namespace stackabilization::apps
