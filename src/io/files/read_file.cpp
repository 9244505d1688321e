#include "stackabilization/io/read_file.h"

#include <cerrno>
#include <cstdio>
#include <cstring>
#include <memory>

#include "stackabilization/core/errors.h"

namespace stackabilization {

namespace {

struct FileCloser {
  void operator()(std::FILE* file) const { std::fclose(file); }
};

std::string read_all(std::FILE* file, std::size_t expected, const std::string& name) {
  constexpr std::size_t first_block = 65536;
  std::string bytes(expected > 0 ? expected + 1 : first_block, '\0');
  std::size_t filled = 0;
  for (;;) {
    filled += std::fread(bytes.data() + filled, 1, bytes.size() - filled, file);
    if (filled < bytes.size()) break;
    bytes.resize(2 * bytes.size());
  }
  if (std::ferror(file)) throw InputError(name + " cannot be read: " + std::strerror(errno));
  bytes.resize(filled);
  return bytes;
}

}  // namespace

std::string read_file(const std::filesystem::path& path) {
  if (path == "-") return read_all(stdin, 0, "standard input");
  std::error_code error;
  const std::filesystem::file_status status = std::filesystem::status(path, error);
  if (!std::filesystem::exists(status))
    throw InputError(
        path.string() + " cannot be read: " +
        (status.type() == std::filesystem::file_type::not_found ? "no such file" : error.message()));
  if (std::filesystem::is_directory(status))
    throw InputError(path.string() + " is a folder, expected a file");
  const std::unique_ptr<std::FILE, FileCloser> file(std::fopen(path.c_str(), "rb"));
  if (!file) throw InputError(path.string() + " cannot be read: " + std::strerror(errno));
  std::size_t size = 0;
  if (std::filesystem::is_regular_file(status)) {
    const std::uintmax_t stated = std::filesystem::file_size(path, error);
    if (!error) size = static_cast<std::size_t>(stated);
  }
  return read_all(file.get(), size, path.string());
}

}  // namespace stackabilization
