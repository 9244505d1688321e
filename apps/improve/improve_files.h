#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "apps/common/owned_folder.h"
#include "apps/improve/improve_options.h"

/// The folder that `stackabilize improve` fills.
namespace stackabilization::apps {

/// The folder of --output. The state of a search is known by its content; with --resume it is read, so that
/// what is wrong with it is said by its reader.
OwnedFolder improve_folder(const ImproveCommandOptions& options);

/// Where the state of a search is kept.
std::filesystem::path state_file(const std::filesystem::path& folder);

/// The project file of all solutions.
inline constexpr const char* project_name = "solutions.stackabilize.json";

/// index.html, result.json and the project of all solutions, which are written last: where they are, all that
/// they speak of is there too, and of one run.
const std::vector<std::string>& summary_names();

/// All files of a solution, "solution_1.obj" and so on.
std::vector<std::string> solution_files(const std::string& solution);
/// All files of a piece of an object that is taken apart, "piece_1.obj" and so on.
std::vector<std::string> piece_files(const std::string& piece);

}  // namespace stackabilization::apps
