#include "apps/common/page_files.h"

#include "apps/common/embedded_files.h"

namespace stackabilization::apps {

namespace {

std::string type_of(std::string_view path) {
  const std::string_view ending = path.substr(path.rfind('.') + 1);
  if (ending == "html") return "text/html; charset=utf-8";
  if (ending == "js") return "text/javascript; charset=utf-8";
  if (ending == "css") return "text/css; charset=utf-8";
  if (ending == "svg") return "image/svg+xml";
  return "application/octet-stream";
}

}  // namespace

std::optional<PageFile> page_file(std::string_view path) {
  for (const EmbeddedFile& file : embedded_files())
    if (path == file.path) return PageFile{file.bytes, type_of(path)};
  return std::nullopt;
}

}  // namespace stackabilization::apps
