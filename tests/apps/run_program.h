#pragma once

#include <sys/types.h>

#include <Eigen/Core>
#include <filesystem>
#include <functional>
#include <map>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "stackabilization/core/shape.h"

namespace stackabilization::apps {

/// Of a command line, without the program.
using Arguments = std::vector<std::string>;

Arguments joined(Arguments a, const Arguments& b);

/// Of all commands of `stackabilize`.
const std::vector<std::string>& command_names();

/// A folder of its own, gone with the object.
class TemporaryFolder {
 public:
  TemporaryFolder();
  ~TemporaryFolder();
  TemporaryFolder(const TemporaryFolder&) = delete;
  TemporaryFolder& operator=(const TemporaryFolder&) = delete;

  const std::filesystem::path& path() const { return path_; }
  /// Path of a file in it.
  std::string operator/(const std::string& name) const { return (path_ / name).string(); }
  /// A file with these bytes.
  std::string file(const std::string& name, const std::string& bytes) const;
  /// A mesh file in the format of its extension.
  std::string model(const std::string& name, const Shape& shape) const;
  /// Names of all files in it, sorted.
  std::vector<std::string> names() const;

 private:
  std::filesystem::path path_;
};

/// What a run of the program left.
struct Outcome {
  int status = -1;       ///< exit status
  std::string out, err;  ///< standard output and error

  nlohmann::json json() const { return nlohmann::json::parse(out); }
};

Eigen::Vector3d vector_of(const nlohmann::json& numbers);

/// Runs `stackabilize` with these arguments and `input` on standard input. `prefix` goes before the program.
Outcome run_program(const Arguments& arguments, const std::string& input = "",
                    const std::string& prefix = "");

/// Runs `stackabilize` with these arguments and sends it `signal` as soon as `ready` says so of the process,
/// however long that takes on a slow machine. Fails the test when the program ends before, or is not ready
/// after some minutes.
Outcome run_and_signal(const Arguments& arguments, int signal, const std::function<bool(pid_t)>& ready);

/// Seconds that a process has computed so far, over all of its threads.
double processor_seconds(pid_t process);

/// Is it one sentence of the program, on one line?
bool is_one_sentence(const std::string& text);

/// Runs it and checks that it ends with `status`, with nothing on standard output and one sentence that
/// contains `words`, and that `folder` has the files that it had.
void check_refused(const TemporaryFolder& folder, const Arguments& arguments, int status,
                   const std::string& words);

std::string bytes_of(const std::string& path);

/// Names and bytes of the files of a folder; none when there is no folder.
std::map<std::string, std::string> contents(const std::filesystem::path& folder);

}  // namespace stackabilization::apps
