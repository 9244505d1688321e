#pragma once

#include <filesystem>
#include <functional>
#include <string>
#include <vector>

namespace stackabilization {

/// The input and output files of a program. `check` compares them before the program runs, so that no result
/// replaces an input.
///
/// Files are compared by device and inode: through symbolic and hard links, through linked folders, and
/// through names in upper and lower case on file systems that ignore case. A missing file is compared by its
/// folder and name. Writing to a symbolic link writes its target, whether this exists or not. A name of the
/// temporary files of write_file.h counts as the name of the file being written.
class FilePlan {
 public:
  /// Adds an input file; "-" is standard input. `what` is its name in messages: "the model".
  void reads(std::string what, std::filesystem::path path);
  /// Adds an input file, or all files in a folder and its subfolders. A path that does not exist adds
  /// nothing.
  void reads_all(const std::string& what, const std::filesystem::path& path);
  /// Adds an output file; "-" is standard output. `option` is the command-line option that requests it:
  /// "--json". Throws UsageError for an empty path.
  void writes(std::string option, std::filesystem::path path);
  /// Adds an output file that the program also reads and replaces on purpose. Throws as `writes` does.
  void updates(std::string option, std::filesystem::path path);
  /// Adds an output folder, created when missing. The program writes, replaces and removes files in it for
  /// whose names `is_written` is true. Throws UsageError for "-" and for an empty path.
  void fills(std::string option, std::filesystem::path folder,
             std::function<bool(const std::string& name)> is_written);

  /// Checks the plan. Throws UsageError when an output would replace or remove an input, when two outputs are
  /// the same file, and when a folder to be created has the name of a file. Throws OutputError when a file or
  /// folder cannot be written: something else has its name, its folder is missing, it or its folder is
  /// write-protected, or its device is full. Terminals, pipes and devices are not compared.
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
