#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace stackabilization::experiments {

/// A program to be run on its own.
struct ChildProcess {
  std::vector<std::string> words;  ///< the program and its arguments
  std::filesystem::path log;       ///< where its standard output and error go
  int max_processor_seconds = 0;   ///< it is killed when it has used so many; 0: no limit
};

/// How a child process ended and what it used.
struct ChildOutcome {
  int status = 0;                ///< its exit status, or 128 and more when it was killed by a signal
  double seconds = 0;            ///< elapsed
  double processor_seconds = 0;  ///< of all its threads
  double megabytes = 0;          ///< most memory that it held at once, 10^6 bytes

  bool killed() const { return status >= 128; }
};

/// Runs a program to its end. It ends with this process. Throws OutputError when no process can be made; a
/// program that cannot be started ends with status 127.
ChildOutcome run_child(const ChildProcess& child);

/// The first line of a file, empty when there is none: what a program said first.
std::string first_line(const std::filesystem::path& file);

}  // namespace stackabilization::experiments
