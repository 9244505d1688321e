#include <algorithm>
#include <filesystem>

#include "stackabilization/io/read.h"
#include "stackabilization/structure/analysis.h"
#include "support/catch.h"
#include "support/random_edits.h"
#include "support/repetitions.h"

using namespace stackabilization;
using namespace stackabilization::random_edits;

TEST_CASE("a thousand random edits of every shipped model leave no broken relation") {
  const std::filesystem::path folder = std::filesystem::path(STACKABILIZATION_SOURCE_DIR) / "data" / "models";
  std::vector<std::filesystem::path> models;
  for (const auto& entry : std::filesystem::directory_iterator(folder)) models.push_back(entry.path());
  std::sort(models.begin(), models.end());
  for (const std::filesystem::path& path : models) {
    INFO(path.filename());
    const ControllerModel model(analyse_structure(read_shape(path)));
    const std::map<std::string, Tally> tallies = run(model, test::repetitions(1000), 42);
    report(path.stem().string(), tallies);
    CHECK(acceptance(tallies) > 0.5);
  }
}
