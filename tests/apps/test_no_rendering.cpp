#include "apps/run_program.h"
#include "support/catch.h"
#include "support/solids.h"

using namespace stackabilization;
using namespace stackabilization::apps;

TEST_CASE("a program without rendering says so instead of drawing") {
  const TemporaryFolder folder;
  const std::string box = folder.model("box.obj", solids::box({1, 2, 3}));
  const std::vector<std::vector<std::string>> cases = {
      {"measure", box, "--method", "gl-raster"},
      {"measure", box, "--picture", folder / "box.png"},
      {"map", box, "--picture", folder / "box.svg"},
      {"stack", box, "--picture", folder / "box.png"},
      {"suggest", box, "--pictures", folder / "ideas"},
      {"structure", box, "--picture", folder / "box.png"},
      {"deform", box, "--edit", "shape scale 2", "--picture", folder / "box.png"}};
  for (const std::vector<std::string>& arguments : cases) {
    const Outcome outcome = run_program(arguments);
    CHECK(outcome.status == 2);
    CHECK(is_one_sentence(outcome.err));
    CHECK(outcome.err.find("without rendering") != std::string::npos);
  }
  CHECK(folder.names() == std::vector<std::string>{"box.obj"});
}
