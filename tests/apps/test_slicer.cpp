// The stack of prints, as a slicer reads it.
#include <cstdlib>
#include <iostream>
#include <sstream>
#include <string>

#include "apps/run_program.h"
#include "support/catch.h"
#include "support/solids.h"

using namespace stackabilization;
using namespace stackabilization::apps;

namespace {

/// Sides of the tile, mm.
const Eigen::Vector3d tile(40, 30, 2);

int count_lines(const std::string& text, const std::string& line) {
  std::istringstream lines(text);
  int count = 0;
  for (std::string found; std::getline(lines, found);) count += found == line ? 1 : 0;
  return count;
}

}  // namespace

TEST_CASE("a slicer finds every layer of a stack of prints, with separators between the copies") {
  if (std::system("prusa-slicer --help >/dev/null 2>&1") != 0) {
    std::cout << "SKIPPED: prusa-slicer is not installed\n";
    return;
  }
  const TemporaryFolder folder;
  Shape shape = solids::box(tile);
  shape.unit = Unit::millimetre;
  const std::string model = folder.model("tile.3mf", shape), stack = folder / "stack.3mf",
                    code = folder / "stack.gcode";
  REQUIRE(run_program({"stack", model, "-n", "4", "--layer", "0.25", "--clearance", "0.2", "--separators",
                       "-o", stack})
              .status == 0);
  // Four tiles of eight layers each, and three gaps of one layer.
  const std::string slice =
      "prusa-slicer --export-gcode --no-ensure-on-bed --layer-height 0.25 --first-layer-height 0.25 "
      "--datadir '" +
      folder.path().string() + "/settings' -o '" + code + "' '" + stack + "' >'" + (folder / "log") +
      "' 2>&1";
  const int status = std::system(slice.c_str());
  INFO(bytes_of(folder / "log"));
  REQUIRE(status == 0);
  CHECK(count_lines(bytes_of(code), ";LAYER_CHANGE") == 4 * 8 + 3);
  CHECK(count_lines(bytes_of(code), ";Z:8.75") == 1);
}
