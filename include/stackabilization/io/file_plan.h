#pragma once

#include <filesystem>
#include <functional>
#include <string>
#include <vector>

namespace stackabilization {

/// The files that a program reads and those that it will write, held against each other before it works, so
/// that no result ever takes the place of what was read.
///
/// Files are compared by device and inode, so through symbolic and hard links, folders that are links, and
/// names in upper and lower case where the file system takes them for one; what is not there yet is compared
/// by its folder and name. What a symbolic link leads to is what is written, be it there or not. A name of
/// the temporary files of write_file.h counts as that of the file that is being written.
class FilePlan {
 public:
  /// A file that is read; "-" is standard input. `what` is what messages call it: "the model".
  void reads(std::string what, std::filesystem::path path);
  /// A file, or every file in a folder and the folders in it. Nothing where nothing is.
  void reads_all(const std::string& what, const std::filesystem::path& path);
  /// A file that is written; "-" is standard output. `option` is what asked for it: "--json". Throws
  /// UsageError for an empty path.
  void writes(std::string option, std::filesystem::path path);
  /// The same for a file that is read first, and is meant to be replaced by what is made of it.
  void updates(std::string option, std::filesystem::path path);
  /// A folder, made where it is missing, in which files with these names are written, replaced and removed.
  /// Throws UsageError for "-" and an empty path.
  void fills(std::string option, std::filesystem::path folder,
             std::function<bool(const std::string& name)> is_written);

  /// Throws UsageError when a file that is read would be replaced or removed, two outputs name one file, or a
  /// folder that is to be made is called like a file; OutputError when a file or folder cannot be written:
  /// there is something else in its place, no folder around it, it or its folder is write-protected, or its
  /// device is full. Terminals, pipes and devices are not compared.
  void check() const;

 private:
  friend class FilePlanCheck;

  struct Input {
    std::string what;
    std::filesystem::path path;
  };
  struct Output {
    std::string option;
    std::filesystem::path path;
    bool updates = false;
  };
  struct Folder {
    std::string option;
    std::filesystem::path path;
    std::function<bool(const std::string&)> is_written;
  };

  std::vector<Input> inputs_;
  std::vector<Output> outputs_;
  std::vector<Folder> folders_;
};

}  // namespace stackabilization
