#include "stackabilization/shape/write_file.h"

#include <unistd.h>

#include <cerrno>
#include <cstdio>
#include <cstring>
#include <string>

#include "stackabilization/shape/errors.h"

namespace stackabilization {

namespace {

[[noreturn]] void fail(const std::string& name, const std::string& reason) {
  throw OutputError(name + " cannot be written: " + reason);
}

/// Closes `file` unless it is standard output. Returns the reason of a failure or nothing.
std::string write_all(std::FILE* file, std::string_view bytes) {
  errno = 0;
  bool good = std::fwrite(bytes.data(), 1, bytes.size(), file) == bytes.size();
  good = std::fflush(file) == 0 && good;
  std::string reason = good ? "" : std::strerror(errno);
  if (file != stdout && std::fclose(file) != 0 && good) reason = std::strerror(errno);
  return reason;
}

void write_directly(const std::filesystem::path& path, std::string_view bytes) {
  std::FILE* const file = std::fopen(path.c_str(), "wb");
  const std::string reason = file ? write_all(file, bytes) : std::strerror(errno);
  if (!reason.empty()) fail(path.string(), reason);
}

}  // namespace

void write_file_atomically(const std::filesystem::path& path, std::string_view bytes) {
  if (path == "-") {
    const std::string reason = write_all(stdout, bytes);
    if (!reason.empty()) fail("standard output", reason);
    return;
  }
  std::error_code error;
  const std::filesystem::file_status status = std::filesystem::status(path, error);
  if (std::filesystem::is_directory(status)) fail(path.string(), "it is a folder");
  if (std::filesystem::exists(status) && !std::filesystem::is_regular_file(status))
    return write_directly(path, bytes);

  // A link keeps pointing to its file, which is what gets replaced.
  std::filesystem::path target = path;
  error.clear();
  if (std::filesystem::exists(status)) target = std::filesystem::canonical(path, error);
  if (error) fail(path.string(), error.message());
  std::filesystem::path temporary = target;
  temporary += '.';
  temporary += std::to_string(getpid());
  temporary += ".tmp";
  std::FILE* const file = std::fopen(temporary.c_str(), "wbx");
  if (!file) fail(path.string(), std::strerror(errno));
  error.clear();
  if (std::filesystem::exists(status)) std::filesystem::permissions(temporary, status.permissions(), error);
  std::string reason = write_all(file, bytes);
  if (reason.empty() && error) reason = error.message();
  if (reason.empty()) {
    std::filesystem::rename(temporary, target, error);
    if (error) reason = error.message();
  }
  if (reason.empty()) return;
  std::filesystem::remove(temporary, error);
  fail(path.string(), reason);
}

}  // namespace stackabilization
