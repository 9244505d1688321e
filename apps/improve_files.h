#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "apps/improve_options.h"

/// The folder that `stackabilize improve` fills.
namespace stackabilization::apps {

/// Throws UsageError when a file that is read lies where one is written, OutputError when the folder cannot
/// be made or written to.
void check_folder(const ImproveCommandOptions& options);

/// Makes it where it is missing. Throws OutputError.
void make_folder(const std::filesystem::path& folder);

/// Where the state of a search is kept.
std::filesystem::path state_file(const std::filesystem::path& folder);

/// The project file of all solutions.
inline constexpr const char* project_name = "solutions.stackabilize.json";

/// Removes index.html, result.json and the project of all solutions, which are written last: where they are,
/// all that they speak of is there too, and of one run.
void remove_summaries(const std::filesystem::path& folder);

/// Removes what earlier runs left under names that this command gives, but for `kept` and the state, and what
/// they were writing when they were killed.
void remove_other_files(const std::filesystem::path& folder, const std::vector<std::string>& kept);

}  // namespace stackabilization::apps
