#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace stackabilization::experiments {

/// An experiment to be run: a program, its arguments, and the files that its numbers depend on.
struct Job {
  std::string name;  ///< its outputs are the files NAME.* and NAME_* of the results folder
  std::filesystem::path program;
  std::vector<std::string> arguments;  ///< without the results folder
  std::vector<std::filesystem::path> inputs;
};

/// Is it the name of a table or picture that the program of this name writes into the results folder?
bool is_output_of(const std::string& program, const std::string& name);

/// Hash of the program's bytes, the arguments, and names and bytes of the inputs: equal for equal results.
/// Throws InputError when a file cannot be read.
std::string fingerprint(const Job& job);

/// Exit status of the run that left its outputs in `folder`, if that run came to its end with status 0 or 1,
/// had this fingerprint, and all its outputs are still there unchanged.
std::optional<int> completed(const Job& job, const std::filesystem::path& folder);

/// Writes down in NAME.done that the job came to its end. Throws OutputError.
void record_completed(const Job& job, int status, const std::filesystem::path& folder);

/// Forgets that the job was ever run, and its outputs.
void clear(const Job& job, const std::filesystem::path& folder);

}  // namespace stackabilization::experiments
