#include "stackabilization/io/file_plan.h"

#include <sys/stat.h>
#include <sys/statvfs.h>
#include <unistd.h>

#include <array>
#include <optional>
#include <utility>

#include "stackabilization/core/errors.h"
#include "stackabilization/core/text.h"
#include "stackabilization/io/write_file.h"

namespace stackabilization {

namespace {

namespace fs = std::filesystem;
using NameTest = std::function<bool(const std::string&)>;

/// A file or folder on this machine, independent of its name.
struct FileId {
  dev_t device = 0;
  ino_t inode = 0;
  bool operator==(const FileId&) const = default;
};

/// A name in a folder.
struct Entry {
  FileId folder;
  std::string name;
  bool operator==(const Entry&) const = default;
};

/// Resolved path.
struct Place {
  std::optional<FileId> file;  ///< a regular file or a folder, if one is there
  std::vector<Entry> entries;  ///< the path itself, and what each link on the way leads to
};

std::optional<FileId> id_of(const struct stat& status) {
  if (!S_ISREG(status.st_mode) && !S_ISDIR(status.st_mode)) return std::nullopt;
  return FileId{status.st_dev, status.st_ino};
}

std::optional<FileId> id_of(const fs::path& path) {
  struct stat status = {};
  return stat(path.c_str(), &status) == 0 ? id_of(status) : std::nullopt;
}

fs::path folder_of(const fs::path& path) {
  return path.has_parent_path() ? path.parent_path() : ".";
}

/// Of "-", what descriptor `standard` is.
Place place_of(const fs::path& path, int standard) {
  Place place;
  struct stat status = {};
  if (path == "-") {
    if (fstat(standard, &status) == 0 && S_ISREG(status.st_mode)) place.file = id_of(status);
    return place;
  }
  place.file = id_of(path);
  for (const fs::path& step : steps_of_links(path))
    if (const std::optional<FileId> folder = id_of(folder_of(step)))
      place.entries.push_back({*folder, step.filename().string()});
  return place;
}

bool same_file(const Place& a, const Place& b) {
  if (a.file || b.file) return a.file == b.file;
  return !a.entries.empty() && !b.entries.empty() && a.entries.back() == b.entries.back();
}

/// Returns whether writing one, through its temporary names, would replace or remove the other.
bool replaces(const Place& output, const Place& input) {
  if (same_file(output, input)) return true;
  for (const Entry& entry : input.entries) {
    const std::optional<std::string> target = target_of_temporary(entry.name);
    if (target && !output.entries.empty() && output.entries.back() == Entry{entry.folder, *target})
      return true;
  }
  return false;
}

/// Pipes and devices accept any number of outputs.
bool is_device(const fs::path& path) {
  std::error_code error;
  return path != "-" && fs::is_other(fs::status(path, error));
}

/// The superuser respects the permissions that the owner of a file set.
bool is_protected(const fs::path& path) {
  struct stat status = {};
  constexpr mode_t any_write = S_IWUSR | S_IWGRP | S_IWOTH;
  return access(path.c_str(), W_OK) != 0 ||
         (stat(path.c_str(), &status) == 0 && (status.st_mode & any_write) == 0);
}

bool is_full(const fs::path& folder) {
  struct statvfs device = {};
  if (statvfs(folder.c_str(), &device) != 0) return false;
  return (device.f_blocks > 0 && device.f_bavail == 0) || (device.f_files > 0 && device.f_favail == 0);
}

[[noreturn]] void refuse(const fs::path& path, const std::string& reason) {
  throw OutputError(path.string() + " cannot be written: " + reason);
}

void check_around(const fs::path& path, const fs::path& folder) {
  if (is_protected(folder) || access(folder.c_str(), X_OK) != 0)
    refuse(path, "the folder " + folder.string() + " is write-protected");
  if (is_full(folder)) refuse(path, "there is no room left on the device of " + folder.string());
}

void check_writable(const fs::path& path) {
  if (path == "-") return;
  std::error_code error;
  const fs::file_status status = fs::status(path, error);
  if (fs::is_directory(status)) refuse(path, "it is a folder");
  if (fs::exists(status) && !fs::is_regular_file(status)) return;
  const fs::path target = steps_of_links(path).back(), folder = folder_of(target);
  if (fs::is_symlink(fs::symlink_status(target, error))) refuse(path, "its links lead in a circle");
  if (fs::exists(status) && is_protected(target)) refuse(path, "it is write-protected");
  if (!fs::is_directory(folder, error)) refuse(path, "there is no folder " + folder.string());
  check_around(path, folder);
}

fs::path normal(const fs::path& path) {
  return fs::absolute(path).lexically_normal();
}

/// Returns whether a user who types this name expects a file. A folder may be called "v1.2".
bool looks_like_file(const fs::path& path) {
  constexpr std::array<const char*, 20> endings = {".3mf",  ".csv", ".dot",  ".glb", ".gltf", ".htm", ".html",
                                                   ".jpeg", ".jpg", ".json", ".md",  ".obj",  ".off", ".pdf",
                                                   ".ply",  ".png", ".stl",  ".svg", ".txt",  ".vtp"};
  const std::string extension = lower_case(path.extension().string());
  for (const char* const ending : endings)
    if (extension == ending) return true;
  return false;
}

/// Returns whether this is the name of a written file, or of its temporary file.
bool is_affected(const NameTest& is_written, const std::string& name) {
  const std::optional<std::string> target = target_of_temporary(name);
  return is_written(name) || (target && is_written(*target));
}

/// Returns the same for an entry of the folder; some file systems ignore case.
bool is_affected(const NameTest& is_written, const fs::path& file) {
  const std::string name = file.filename().string(), lower = lower_case(name);
  if (is_affected(is_written, name)) return true;
  return is_affected(is_written, lower) && id_of(file) && id_of(file) == id_of(file.parent_path() / lower);
}

/// Returns whether the folder contains a file, or a link to it, under a name that is written there.
bool lies_under(const NameTest& is_written, const FileId& folder, const Place& file) {
  for (const Entry& entry : file.entries)
    if (entry.folder == folder && is_affected(is_written, entry.name)) return true;
  return false;
}

}  // namespace

/// A plan with its resolved paths, looked up once.
class FilePlanCheck {
 public:
  explicit FilePlanCheck(const FilePlan& plan) : plan_(plan) {
    for (const FilePlan::Input& input : plan.inputs_) inputs_.push_back(place_of(input.path, STDIN_FILENO));
    for (const FilePlan::Output& output : plan.outputs_)
      outputs_.push_back(place_of(output.path, STDOUT_FILENO));
  }

  void run() const {
    for (std::size_t i = 0; i < outputs_.size(); ++i) check_output(i);
    for (const FilePlan::Folder& folder : plan_.folders_) check_folder(folder);
  }

 private:
  void check_output(std::size_t i) const {
    const fs::path& path = plan_.outputs_[i].path;
    if (!is_device(path)) compare(i);
    if (!lies_in_new_folder(i)) check_writable(path);
  }

  /// Returns whether an output lies in an output folder that does not exist yet and that the program creates
  /// first. Throws UsageError when the folder would replace the file.
  bool lies_in_new_folder(std::size_t i) const {
    const FilePlan::Output& output = plan_.outputs_[i];
    const fs::path target = steps_of_links(output.path).back();
    std::error_code error;
    for (const FilePlan::Folder& folder : plan_.folders_) {
      const bool is_inside = normal(folder_of(target) / "") == normal(folder.path / "");
      if (output.path == "-" || !is_inside || fs::exists(folder.path, error)) continue;
      if (is_affected(folder.is_written, target.filename().string()))
        throw UsageError(folder.option + " would replace what " + output.option + " writes, " +
                         output.path.string());
      return true;
    }
    return false;
  }

  void compare(std::size_t i) const {
    const FilePlan::Output& output = plan_.outputs_[i];
    for (std::size_t k = 0; k < inputs_.size(); ++k) {
      const FilePlan::Input& input = plan_.inputs_[k];
      if (!(output.updates && input.path == output.path) && replaces(outputs_[i], inputs_[k]))
        throw UsageError(output.option + " would replace " + input.what + " " + input.path.string());
    }
    for (std::size_t k = 0; k < i; ++k) {
      const FilePlan::Output& other = plan_.outputs_[k];
      if (other.path == output.path || replaces(outputs_[i], outputs_[k]) ||
          replaces(outputs_[k], outputs_[i]))
        throw UsageError(other.option + " and " + output.option + " name the same output, " +
                         output.path.string());
    }
  }

  void check_folder(const FilePlan::Folder& folder) const {
    const fs::path& path = folder.path;
    std::error_code error;
    const fs::file_status status = fs::status(path, error);
    if (fs::is_directory(status)) {
      check_around(path, path);
      check_names(folder);
      for (const fs::directory_entry& entry : fs::directory_iterator(path, error))
        if (is_affected(folder.is_written, entry.path())) check_entry(folder, entry);
      return;
    }
    if (fs::exists(status)) throw OutputError(path.string() + " cannot be filled: it is not a folder");
    if (looks_like_file(path.has_filename() ? path : path.parent_path()))
      throw UsageError(folder.option + " expects a folder, and " + path.string() +
                       " is called like a file: give another name, or make that folder first");
    fs::path existing = normal(path);
    while (!fs::exists(fs::symlink_status(existing, error)) && existing.has_relative_path())
      existing = existing.parent_path();
    if (!fs::is_directory(existing, error)) refuse(path, existing.string() + " is not a folder");
    check_around(path, existing);
  }

  /// Throws UsageError when the folder would replace an input or output under a name in the folder, whether
  /// the file exists or not.
  void check_names(const FilePlan::Folder& folder) const {
    const std::optional<FileId> id = id_of(folder.path);
    if (!id) return;
    for (std::size_t k = 0; k < inputs_.size(); ++k)
      if (lies_under(folder.is_written, *id, inputs_[k]))
        throw UsageError(folder.option + " would replace " + plan_.inputs_[k].what + " " +
                         plan_.inputs_[k].path.string());
    for (std::size_t k = 0; k < outputs_.size(); ++k)
      if (lies_under(folder.is_written, *id, outputs_[k]))
        throw UsageError(folder.option + " would replace what " + plan_.outputs_[k].option + " writes, " +
                         plan_.outputs_[k].path.string());
  }

  /// Checks an existing entry of the folder that would be replaced or removed.
  void check_entry(const FilePlan::Folder& folder, const fs::directory_entry& entry) const {
    const fs::path& file = entry.path();
    const Place place = place_of(file, STDOUT_FILENO);
    const std::string would = folder.option + " would replace " + file.string() + ", which is ";
    for (std::size_t k = 0; k < inputs_.size(); ++k)
      if (same_file(place, inputs_[k]))
        throw UsageError(would + plan_.inputs_[k].what + " " + plan_.inputs_[k].path.string());
    for (std::size_t k = 0; k < outputs_.size(); ++k)
      if (same_file(place, outputs_[k]))
        throw UsageError(would + "what " + plan_.outputs_[k].option + " writes");
    std::error_code error;
    if (entry.is_symlink(error)) refuse(file, "it is a link: take it away, or choose another folder");
    if (entry.is_directory(error)) refuse(file, "it is a folder: take it away, or choose another folder");
    if (!entry.is_regular_file(error)) refuse(file, "it is no file: take it away, or choose another folder");
    if (is_protected(file)) refuse(file, "it is write-protected");
  }

  const FilePlan& plan_;
  std::vector<Place> inputs_, outputs_;
};

void FilePlan::reads(std::string what, fs::path path) {
  inputs_.push_back({std::move(what), std::move(path)});
}

void FilePlan::reads_all(const std::string& what, const fs::path& path) {
  std::error_code error;
  if (fs::is_regular_file(path, error)) reads(what, path);
  if (!fs::is_directory(path, error)) return;
  for (fs::recursive_directory_iterator it(path, error), end; !error && it != end; it.increment(error))
    if (std::error_code unknown; !it->is_directory(unknown)) reads(what, it->path());
}

void FilePlan::writes(std::string option, fs::path path) {
  if (path.empty()) throw UsageError(option + " expects a file name, found an empty one");
  outputs_.push_back({std::move(option), std::move(path)});
}

void FilePlan::updates(std::string option, fs::path path) {
  outputs_.push_back({std::move(option), std::move(path), true});
}

void FilePlan::fills(std::string option, fs::path folder, NameTest is_written) {
  if (folder.empty() || folder == "-")
    throw UsageError(option + " expects a folder, found '" + folder.string() + "'");
  folders_.push_back({std::move(option), std::move(folder), std::move(is_written)});
}

void FilePlan::check() const {
  FilePlanCheck(*this).run();
}

}  // namespace stackabilization
