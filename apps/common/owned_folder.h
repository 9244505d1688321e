#pragma once

#include <filesystem>
#include <functional>
#include <map>
#include <optional>
#include <string>
#include <vector>

namespace stackabilization::apps {

/// A folder that a command fills with files whose names it chooses, and in which it knows its own.
///
/// A list in the folder, stackabilize-files.json, names what was written there, each with a hash of its
/// bytes, or with none while it is being written. Files on the list that are as they were written are
/// replaced and removed; anything else under a name of the command is in the way, and stays.
class OwnedFolder {
 public:
  /// Is it a name that the command gives to files?
  using NameTest = std::function<bool(const std::string& name)>;
  /// Is it, by its content, a file that the command makes, though it is on no list?
  using FileTest = std::function<bool(const std::filesystem::path& file)>;

  OwnedFolder(std::filesystem::path path, NameTest is_name, FileTest is_known = nullptr);

  const std::filesystem::path& path() const { return path_; }
  /// May a file of this name be written or removed? True for the list too.
  bool is_written(const std::string& name) const;
  /// Throws OutputError naming the first file that is in the way. The folder may be missing.
  void check() const;
  /// Makes the folder where it is missing. Throws OutputError.
  void make() const;
  /// Makes the folder, checks again, and lists these names as being written. Throws OutputError.
  void begin(const std::vector<std::string>& names) const;
  /// Removes a file that is on the list or known by its content, if it is there.
  void remove(const std::string& name) const;
  /// Removes what is on the list under names of the command, but for `kept`, and what a run that was killed
  /// left half written.
  void remove_others(const std::vector<std::string>& kept) const;
  /// Lists these files of the command, as they are now, and no others. Throws OutputError.
  void finish(const std::vector<std::string>& written) const;

 private:
  /// Hash by name; none for a file that is being written.
  using List = std::map<std::string, std::optional<std::string>>;

  List list() const;
  void write(const List& list) const;

  std::filesystem::path path_;
  NameTest is_name_;
  FileTest is_known_;
};

}  // namespace stackabilization::apps
