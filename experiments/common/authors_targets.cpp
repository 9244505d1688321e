#include "common/authors_targets.h"

#include <cctype>
#include <charconv>
#include <fstream>

#include "stackabilization/core/errors.h"

namespace stackabilization::experiments {

namespace fs = std::filesystem;

std::string plain_task_name(const std::string& stem) {
  std::string name;
  for (const char c : stem)
    if (std::isalpha(static_cast<unsigned char>(c)) != 0)
      name += static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  if (const std::size_t bar = name.find("middlebar"); bar != std::string::npos)
    name.replace(bar, 9, "midbar");
  return name;
}

std::map<std::string, AuthorsTarget> authors_targets(const fs::path& paper_data) {
  const fs::path file = paper_data / "user-study-graphics" / "UserStudyApp" / "tasks.txt";
  std::ifstream stream(file);
  if (!stream) throw InputError(file.string() + ": cannot be opened for reading");
  std::map<std::string, AuthorsTarget> result;
  std::string line;
  for (int number = 1; std::getline(stream, line); ++number) {
    while (!line.empty() && (line.back() == '\r' || line.back() == ' ')) line.pop_back();
    if (line.empty()) continue;
    const std::size_t blank = line.rfind(' ');
    double target = 0;
    const char* end = line.data() + line.size();
    if (blank == std::string::npos || std::from_chars(line.data() + blank + 1, end, target).ptr != end)
      throw InputError(file.string() + ", line " + std::to_string(number) + ": expected a path and a target");
    const std::string task = fs::path(line.substr(0, blank)).stem().string();
    result[plain_task_name(task)] = {task, target};
  }
  return result;
}

}  // namespace stackabilization::experiments
