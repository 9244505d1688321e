#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace stackabilization::apps {

/// A task for `improve`. Its directions are not given, so that they are looked for.
struct ResumableTask {
  std::filesystem::path model;
  std::vector<std::string> options;

  std::vector<std::string> into(const std::string& folder, const std::vector<std::string>& further) const;
};

/// Runs the task at once, and in pieces that a limit of expansions and a signal end, however far that is, and
/// checks that both leave the same files. A model that is refused needs a sentence that says why.
void check_resumed(const ResumableTask& task);

}  // namespace stackabilization::apps
