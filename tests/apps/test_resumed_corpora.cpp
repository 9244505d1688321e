#include <algorithm>
#include <cstdlib>
#include <iostream>

#include "apps/resumed_run.h"
#include "support/catch.h"

using namespace stackabilization::apps;

namespace {

namespace fs = std::filesystem;

/// Meshes that a folder of outside models has, or none when the variable does not name it.
std::vector<fs::path> meshes_below(const char* variable) {
  std::vector<fs::path> files;
  const char* const root = std::getenv(variable);
  if (!root) {
    std::cout << "SKIPPED: " << variable << " names no folder\n";
    return files;
  }
  for (const auto& entry : fs::recursive_directory_iterator(root)) {
    const std::string extension = entry.path().extension().string();
    if (extension == ".obj" || extension == ".off" || extension == ".stl" || extension == ".ply")
      files.push_back(entry.path());
  }
  std::sort(files.begin(), files.end());
  return files;
}

}  // namespace

TEST_CASE("a run in pieces ends with the files of a run at once, for every model of the corpora") {
  for (const char* variable : {"STACKABILIZATION_CORPORA", "STACKABILIZATION_PAPER_DATA"})
    for (const fs::path& model : meshes_below(variable))
      check_resumed({model, {"--up", "y", "--target", "0.8", "--effort", "0.01"}});
}
