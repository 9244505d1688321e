#include "apps/improve/improve_files.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <string_view>

#include "stackabilization/improvement/best_first.h"
#include "stackabilization/io/read_file.h"

namespace stackabilization::apps {

namespace {

namespace fs = std::filesystem;

constexpr const char* state_name = "search-state.json";
constexpr std::array<const char*, 6> solution_endings = {
    ".obj", ".3mf", ".stackabilize.json", ".json", "_before_after.png", "_stack.png"};
constexpr std::array<const char*, 2> piece_endings = {".obj", "_stack.png"};

/// Is it a name such as "solution_3"?
bool is_numbered(const std::string& name, std::string_view start) {
  return name.size() > start.size() && name.starts_with(start) &&
         std::all_of(name.begin() + static_cast<std::ptrdiff_t>(start.size()), name.end(),
                     [](unsigned char c) { return std::isdigit(c) != 0; });
}

bool is_solution(const std::string& name) {
  return name == "nearest" || is_numbered(name, "solution_");
}

bool is_piece(const std::string& name) {
  return is_numbered(name, "piece_");
}

/// Is it a file with one of these endings of something whose name passes the test?
template <class Endings>
bool is_file_of(const std::string& file, const Endings& endings, bool (*is_name)(const std::string&)) {
  return std::any_of(endings.begin(), endings.end(), [&](const std::string& ending) {
    return file.ends_with(ending) && is_name(file.substr(0, file.size() - ending.size()));
  });
}

/// Is it a name that this command gives to files?
bool is_written(const std::string& file) {
  const std::vector<std::string>& summaries = summary_names();
  return file == state_name || std::find(summaries.begin(), summaries.end(), file) != summaries.end() ||
         is_file_of(file, solution_endings, is_solution) || is_file_of(file, piece_endings, is_piece);
}

/// Is it a state, whose reader says what is wrong with it if it is to be read?
bool is_state(const fs::path& file, bool is_read) {
  if (file.filename() != state_name) return false;
  try {
    return is_read || is_search_state(read_file(file));
  } catch (const InputError&) {
    return false;
  }
}

}  // namespace

OwnedFolder improve_folder(const ImproveCommandOptions& options) {
  return {options.folder, is_written,
          [is_read = options.resume](const fs::path& file) { return is_state(file, is_read); }};
}

fs::path state_file(const fs::path& folder) {
  return folder / state_name;
}

const std::vector<std::string>& summary_names() {
  static const std::vector<std::string> names = {"index.html", "result.json", project_name, "front.csv",
                                                 "front.png"};
  return names;
}

std::vector<std::string> solution_files(const std::string& solution) {
  std::vector<std::string> files;
  for (const std::string ending : solution_endings) files.push_back(solution + ending);
  return files;
}

std::vector<std::string> piece_files(const std::string& piece) {
  std::vector<std::string> files;
  for (const std::string ending : piece_endings) files.push_back(piece + ending);
  return files;
}

}  // namespace stackabilization::apps
