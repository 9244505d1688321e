#pragma once

#include <functional>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include "apps/run_program.h"

/// Command lines whose inputs and outputs are one file.
namespace stackabilization::apps {

/// An option that names what is written, and the rest of a command line that gets as far as looking at files.
struct Output {
  std::string command, option, extension;  ///< of a file; empty: a folder
  Arguments further = {};
};

/// All of them, of all commands.
const std::vector<Output>& outputs();

/// Names under which a command writes in the folder that it fills, one of each kind; by command.
const std::map<std::string, std::vector<std::string>>& names_in_folders();

/// A folder with the files of one command line, in.obj among them.
struct Scene : TemporaryFolder {
  explicit Scene(const Output& output);

  /// The command line that reads `mesh`, and by `input` the file `read`, and writes `written`.
  Arguments line(const std::string& mesh, const std::string& written, const std::string& input = "",
                 const std::string& read = "") const;
  /// Runs it, and checks that it ends with 2 and a sentence in which the regular expression `words` is found,
  /// and that everything in the folder is as it was: bytes, rights, links.
  void check_refused(const Arguments& arguments, const std::string& words) const;

  Output what;
  std::string bytes;  ///< of in.obj
};

/// Makes what is read and what is written the same file, and returns the paths of both. `name` is the
/// extension of a file, or a name in a folder.
using Same = std::function<std::pair<std::string, std::string>(const Scene&, const std::string& name)>;

/// Ways in which a file that is read and one that is written can be the same.
const std::map<std::string, Same>& ways_to_be_the_same();
/// The same for a file of this name in the folder that a command fills.
const std::map<std::string, Same>& ways_to_lie_in_a_folder();

}  // namespace stackabilization::apps
