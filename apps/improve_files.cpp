#include "apps/improve_files.h"

#include <unistd.h>

#include <algorithm>
#include <array>
#include <cctype>

#include "stackabilization/shape/write_file.h"

namespace stackabilization::apps {

namespace {

namespace fs = std::filesystem;

constexpr const char* state_name = "search-state.json";
/// Those that speak of all solutions.
constexpr std::array<const char*, 3> summaries = {"index.html", "result.json", project_name};
constexpr std::array<const char*, 6> endings = {
    ".obj", ".3mf", ".stackabilize.json", ".json", "_before_after.png", "_stack.png"};

/// Is it a name of a solution, "nearest" or "solution_3"?
bool is_solution(const std::string& name) {
  const std::string start = "solution_";
  return name == "nearest" || (name.size() > start.size() && name.starts_with(start) &&
                               std::all_of(name.begin() + static_cast<std::ptrdiff_t>(start.size()),
                                           name.end(), [](unsigned char c) { return std::isdigit(c) != 0; }));
}

/// Is it a name that this command gives to files?
bool is_written(const std::string& file) {
  return file == state_name || std::find(summaries.begin(), summaries.end(), file) != summaries.end() ||
         std::any_of(endings.begin(), endings.end(), [&](const std::string& ending) {
           return file.ends_with(ending) && is_solution(file.substr(0, file.size() - ending.size()));
         });
}

bool lies_in(const fs::path& folder, const std::string& file) {
  std::error_code error;
  const fs::path parent = fs::path(file).has_parent_path() ? fs::path(file).parent_path() : fs::path(".");
  return file != "-" && fs::equivalent(parent, folder, error);
}

}  // namespace

void check_folder(const ImproveCommandOptions& options) {
  const fs::path folder = options.folder;
  std::error_code error;
  if (folder.empty() || folder == "-")
    throw UsageError("--output expects a folder, found '" + options.folder + "'");
  if (fs::exists(folder, error) && !fs::is_directory(folder, error))
    throw OutputError(options.folder + " cannot be filled with solutions: it is not a folder");
  fs::path existing = fs::absolute(folder).lexically_normal();
  while (!fs::exists(existing, error) && existing.has_relative_path()) existing = existing.parent_path();
  if (!fs::is_directory(existing, error) || access(existing.c_str(), W_OK) != 0)
    throw OutputError(options.folder + " cannot be written: " + existing.string() +
                      (fs::is_directory(existing, error) ? " is write-protected" : " is not a folder"));
  std::vector<InputFile> files = analysis_inputs(options.analysis);
  files.push_back({"the model", options.common.model});
  if (options.common.read.labels) files.push_back({"the labels", options.common.read.labels->string()});
  if (options.common.json) files.push_back({"what --json writes,", *options.common.json});
  for (const InputFile& file : files)
    if (lies_in(folder, file.path) && is_written(fs::path(file.path).filename().string()))
      throw UsageError("--output would replace " + file.what + " " + file.path);
}

void make_folder(const fs::path& folder) {
  std::error_code error;
  fs::create_directories(folder, error);
  if (error) throw OutputError(folder.string() + " cannot be made: " + error.message());
}

fs::path state_file(const fs::path& folder) {
  return folder / state_name;
}

void remove_summaries(const fs::path& folder) {
  std::error_code error;
  for (const char* const name : summaries) fs::remove(folder / name, error);
}

void remove_other_files(const fs::path& folder, const std::vector<std::string>& kept) {
  std::error_code error;
  std::vector<fs::path> stale;
  for (const auto& entry : fs::directory_iterator(folder, error)) {
    const std::string name = entry.path().filename().string();
    const std::optional<std::string> unfinished = target_of_temporary(name);
    const bool old =
        is_written(name) && name != state_name && std::find(kept.begin(), kept.end(), name) == kept.end();
    if (old || (unfinished && is_written(*unfinished))) stale.push_back(entry.path());
  }
  for (const fs::path& file : stale) fs::remove(file, error);
}

}  // namespace stackabilization::apps
