#include "stackabilization/io/write_file.h"

#include <signal.h>
#include <unistd.h>

#include <cerrno>
#include <charconv>
#include <cstdio>
#include <cstring>
#include <vector>

#include "stackabilization/core/errors.h"

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

constexpr std::string_view temporary_ending = ".tmp";

/// A temporary file, by its name: "a.obj.4711.tmp" holds what process 4711 is about to call "a.obj".
struct TemporaryName {
  std::string target;
  pid_t writer = 0;
};

std::optional<TemporaryName> parsed(std::string_view name) {
  if (!name.ends_with(temporary_ending)) return std::nullopt;
  name.remove_suffix(temporary_ending.size());
  const std::size_t dot = name.rfind('.');
  if (dot == std::string_view::npos || dot == 0) return std::nullopt;
  TemporaryName result{std::string(name.substr(0, dot)), 0};
  const char* const end = name.data() + name.size();
  const auto [rest, error] = std::from_chars(name.data() + dot + 1, end, result.writer);
  if (error != std::errc() || rest != end || result.writer <= 0) return std::nullopt;
  return result;
}

/// One that is left over from a process of the same number gives way.
std::FILE* open_temporary(const std::filesystem::path& temporary) {
  std::FILE* const file = std::fopen(temporary.c_str(), "wbx");
  if (file || errno != EEXIST) return file;
  std::error_code error;
  std::filesystem::remove(temporary, error);
  return std::fopen(temporary.c_str(), "wbx");
}

/// Removes what writers of `target` left that were killed.
void remove_leftovers(const std::filesystem::path& target) {
  const std::string name = target.filename().string();
  std::error_code error;
  std::vector<std::filesystem::path> left;
  const std::filesystem::path folder = target.has_parent_path() ? target.parent_path() : ".";
  for (const auto& entry : std::filesystem::directory_iterator(folder, error)) {
    const auto temporary = parsed(entry.path().filename().string());
    if (temporary && temporary->target == name && kill(temporary->writer, 0) != 0 && errno == ESRCH)
      left.push_back(entry.path());
  }
  for (const std::filesystem::path& file : left) std::filesystem::remove(file, error);
}

}  // namespace

std::optional<std::string> target_of_temporary(std::string_view name) {
  const auto temporary = parsed(name);
  return temporary ? std::optional(temporary->target) : std::nullopt;
}

std::vector<std::filesystem::path> steps_of_links(const std::filesystem::path& path) {
  constexpr std::size_t max_links = 40;  // as the system
  std::vector<std::filesystem::path> steps = {path};
  std::error_code error;
  while (steps.size() <= max_links) {
    const std::filesystem::path last = steps.back();
    if (!std::filesystem::is_symlink(std::filesystem::symlink_status(last, error))) break;
    const std::filesystem::path next = std::filesystem::read_symlink(last, error);
    if (error) break;
    steps.push_back(last.parent_path() / next);
  }
  return steps;
}

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

  const std::filesystem::path target = steps_of_links(path).back();
  if (std::filesystem::is_symlink(std::filesystem::symlink_status(target, error)))
    fail(path.string(), "its links lead in a circle");
  std::filesystem::path temporary = target;
  temporary += '.' + std::to_string(getpid());
  temporary += temporary_ending;
  std::FILE* const file = open_temporary(temporary);
  if (!file) fail(path.string(), std::strerror(errno));
  error.clear();
  if (std::filesystem::exists(status)) std::filesystem::permissions(temporary, status.permissions(), error);
  std::string reason = write_all(file, bytes);
  if (reason.empty() && error) reason = error.message();
  if (reason.empty()) {
    std::filesystem::rename(temporary, target, error);
    if (error) reason = error.message();
  }
  if (reason.empty()) return remove_leftovers(target);
  std::filesystem::remove(temporary, error);
  fail(path.string(), reason);
}

}  // namespace stackabilization
