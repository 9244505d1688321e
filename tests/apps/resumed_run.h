#pragma once

#include <filesystem>
#include <string>

#include "apps/run_program.h"

namespace stackabilization::apps {

/// A task for `improve`. Its directions are not given, so that they are looked for.
struct ResumableTask {
  std::filesystem::path model;
  Arguments options;

  Arguments into(const std::string& folder, const Arguments& further) const;
};

/// Runs the task at once, and in pieces that a limit of expansions and a signal end, however far that is, and
/// checks that both leave the same files. A model that is refused needs a sentence that says why.
void check_resumed(const ResumableTask& task);

}  // namespace stackabilization::apps
