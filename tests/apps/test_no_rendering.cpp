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
      {"drop", box, "--onto", box, "--picture", folder / "box.png"},
      {"suggest", box, "--pictures", folder / "ideas"},
      {"structure", box, "--picture", folder / "box.png"},
      {"deform", box, "--edit", "shape scale 2", "--picture", folder / "box.png"}};
  for (const std::vector<std::string>& arguments : cases)
    check_refused(folder, arguments, 2, "without rendering");
}

TEST_CASE("solutions are written without pictures, and the page says so") {
  const TemporaryFolder folder;
  const std::string cup = folder.model("cup.obj", solids::frustum_shell({}));
  const Outcome outcome = run_program({"improve", cup, "--target", "0", "--direction", "0", "0", "1",
                                       "--expansions", "5", "-o", folder / "out"});
  CHECK(outcome.status == 0);
  CHECK(outcome.out.find("No pictures: this program was built without rendering") != std::string::npos);
  const std::string page = bytes_of(folder / "out/index.html");
  CHECK(page.find("built without rendering") != std::string::npos);
  CHECK(page.find("<img") == std::string::npos);
}
