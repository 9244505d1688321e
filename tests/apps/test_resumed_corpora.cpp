#include <algorithm>
#include <cstdlib>
#include <iostream>
#include <vector>

#include "apps/resumed_run.h"
#include "support/catch.h"

using namespace stackabilization::apps;

namespace {

namespace fs = std::filesystem;

/// Meshes in the folders of outside models that the variables name.
std::vector<fs::path> outside_meshes() {
  std::vector<fs::path> files;
  for (const char* variable : {"STACKABILIZATION_CORPORA", "STACKABILIZATION_PAPER_DATA"}) {
    const char* const root = std::getenv(variable);
    if (!root) {
      std::cout << variable << " names no folder\n";
      continue;
    }
    for (const auto& entry : fs::recursive_directory_iterator(root)) {
      const std::string extension = entry.path().extension().string();
      if (extension == ".obj" || extension == ".off" || extension == ".stl" || extension == ".ply")
        files.push_back(entry.path());
    }
  }
  std::sort(files.begin(), files.end());
  return files;
}

/// So many of them, evenly spread.
std::vector<fs::path> spread(const std::vector<fs::path>& files, std::size_t count) {
  std::vector<fs::path> chosen;
  for (std::size_t k = 0; k < count; ++k) chosen.push_back(files[(2 * k + 1) * files.size() / (2 * count)]);
  return chosen;
}

}  // namespace

TEST_CASE("a run in pieces ends with the files of a run at once, for models of the corpora") {
  constexpr std::size_t sample = 2;
  std::vector<fs::path> models = outside_meshes();
  if (models.empty()) std::cout << "SKIPPED: there are no outside models\n";
  if (!std::getenv("STACKABILIZATION_EVERY_MODEL") && models.size() > sample) models = spread(models, sample);
  for (const fs::path& model : models)
    check_resumed({model, {"--up", "y", "--target", "0.8", "--effort", "0.1"}});
}
