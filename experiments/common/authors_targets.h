#pragma once

#include <filesystem>
#include <map>
#include <string>

namespace stackabilization::experiments {

/// Task names without the digits, dashes and spellings in which files and tasks.txt differ: "table-midbar"
/// and "table-middlebar" are the same task.
std::string plain_task_name(const std::string& stem);

/// What the authors' user study asks for.
struct AuthorsTarget {
  std::string task;  ///< stem of the file that tasks.txt names
  double target = 0;
};

/// The tasks of the study in tasks.txt of the authors' data, by plain name. Throws InputError when that file
/// is missing or damaged.
std::map<std::string, AuthorsTarget> authors_targets(const std::filesystem::path& paper_data);

}  // namespace stackabilization::experiments
