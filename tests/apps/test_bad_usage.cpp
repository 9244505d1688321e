#include "apps/run_program.h"
#include "support/catch.h"
#include "support/solids.h"

using namespace stackabilization;
using namespace stackabilization::apps;

namespace {

struct BoxFolder : TemporaryFolder {
  std::string box = model("box.obj", solids::box({1, 2, 3}));
};

}  // namespace

TEST_CASE("wrong command lines end with 2 and one sentence that names the mistake") {
  const BoxFolder folder;
  const std::string& box = folder.box;
  const std::string project = folder / "box.json";
  REQUIRE(run_program({"structure", box, "--save", project}).status == 0);
  const std::vector<std::pair<Arguments, std::string>> cases = {
      {{}, "none was given"},
      {{"weigh", box}, "'weigh'"},
      {{"measure"}, "MODEL"},
      {{"measure", box, box}, "not expected"},
      {{"measure", box, "--colour"}, "--colour"},
      {{"measure", box, "--colour", "red", "7"}, "--colour red 7"},
      {{"measure", box, "--direction", "0", "0"}, "--direction"},
      {{"measure", box, "--direction", "0", "0", "0"}, "zero"},
      {{"measure", box, "--direction", "0", "0", "up"}, "'up'"},
      {{"measure", box, "--direction", "nan", "0", "1"}, "three finite numbers, such as 0 0 1, found 'nan'"},
      {{"measure", box, "--direction", "inf", "0", "1"}, "finite"},
      {{"measure", box, "--direction", "1e999", "0", "1"}, "finite"},
      {{"measure", box, "--direction", "1e300", "0", "0"}, "10^-150 to 10^150"},
      {{"measure", box, "--direction", "0", "0", "1e-160"}, "10^-150 to 10^150"},
      {{"measure", "--direction", "0", "0", box}, box},
      {{"measure", "--direction", "0", "0", "1", box, box}, "not expected"},
      {{"measure", box, "--direction", "1,0,0", "0", "1"}, "'1,0,0'"},
      {{"measure", box, "--method", "guess"}, "exact|rays|raster|gl-raster"},
      {{"measure", box, "--resolution", "0"}, "--resolution"},
      {{"measure", box, "--resolution", "100000"}, "--resolution"},
      {{"measure", box, "--semantics", "liquid"}, "solid|closed"},
      {{"measure", box, "--boxes", "round"}, "oriented|frame"},
      {{"measure", box, "--unit", "mile"}, "mm|cm|m|in|ft"},
      {{"measure", box, "--up", "w"}, "x|y|z"},
      {{"measure", box, "--format", "doc"}, "obj|off"},
      {{"measure", box, "--threads", "0"}, "--threads"},
      {{"measure", box, "--threads", "many"}, "--threads"},
      {{"search", box, "--cone-degrees", "0"}, "--cone-degrees"},
      {{"search", box, "--cone-degrees", "91"}, "--cone-degrees"},
      {{"search", box, "--direction", "0", "0", "1"}, "--cone-degrees"},
      {{"search", box, "--plane", "0", "0", "0"}, "--plane"},
      {{"search", box, "--cone-degrees", "5", "--plane", "0", "0", "1"}, "cone"},
      {{"search", box, "--certify", "0"}, "--certify"},
      {{"search", box, "--certify", "1.5"}, "--certify"},
      {{"search", box, "--certify", "0.1", "--boxes", "frame"}, "--boxes oriented only"},
      {{"search", box, "--max-cells", "5", "--boxes", "frame"}, "--boxes oriented only"},
      {{"search", box, "--max-cells", "-1"}, "--max-cells"},
      {{"search", box, "--certify", "0.1", "--max-cells", "0"}, "--max-cells"},
      {{"map", box, "--step-degrees", "0"}, "step"},
      {{"map", box, "--step-degrees", "-1"}, "step"},
      {{"map", box, "--step-degrees", "fine"}, "'fine'"},
      {{"stack", box, "-n", "0"}, "-n"},
      {{"stack", box, "-n", "2.5"}, "-n"},
      {{"stack", box, "-n", "1000000"}, "-n"},
      {{"stack", box, "--twist-degrees", "best"}, "'best'"},
      {{"stack", box, "--period", "9"}, "--period"},
      {{"stack", box, "--period", "2", "--twist-degrees", "auto"}, "--period"},
      {{"measure", box, "--resolution", "two"}, "whole number from 1 to 16384, found 'two'"},
      {{"measure", box, "--seed", "x"}, "whole number from 0 to 18446744073709551615, found 'x'"},
      {{"measure", box, "--seed", "-3"}, "'-3'"},
      {{"measure", box, "--quiet=x"}, "takes no value was given one: --quiet = x"},
      {{"measure", box, "--threads", "2000"}, "whole number from 1 to 1024, found '2000'"},
      {{"stack", box, "--period", "2x"}, "whole number from 1 to 5, found '2x'"},
      {{"stack", box, "--clearance", "1e308"}, "--clearance expects a length of at most 1e60, found 1e308"},
      {{"stack", box, "--into", box, "--clearance", "1e308"},
       "--clearance expects a length of at most 1e60, found 1e308"},
      {{"stack", box, "--clearance", "-1"}, "--clearance"},
      {{"stack", box, "--clearance", "1 league"}, "'1 league'"},
      {{"stack", box, "--clearance", "1mm"}, "--unit"},
      {{"stack", box, "--to-unit", "mm", "--unit", "m"}, "--to-unit needs --output"},
      {{"stack", box, "--to-unit", "mm", "-o", folder / "stack.obj"}, "say it with --unit"},
      {{"structure", project, "--to-unit", "mm", "-o", folder / "parts.obj"}, "say it with --unit"},
      {{"stack", box, "--to-unit", "mile", "--unit", "m"}, "mm|cm|m|in|ft|um"},
      {{"stack", box, "--within", "0"}, "--within"},
      {{"stack", box, "--into", box, "-n", "3"}, "--into"},
      {{"stack", box, "--into", box, "--within", "3"}, "--into"},
      {{"validate", box, "--direction"}, "--direction"},
  };
  for (const auto& [arguments, word] : cases) check_refused(folder, arguments, 2, word);
}

TEST_CASE("outputs that cannot be written are refused before the work") {
  const BoxFolder folder;
  const std::string& box = folder.box;
  const std::string nowhere = folder / "nowhere" + "/result";
  const std::string here = folder.path().string();
  const std::vector<std::pair<Arguments, std::string>> cases = {
      {{"measure", box, "--json", nowhere + ".json"}, "no folder"},
      {{"measure", box, "--json", here}, "folder"},
      {{"measure", box, "--json", ""}, "--json"},
      {{"measure", box, "--json", box}, "replace the model"},
      {{"measure", box, "--picture", folder / "box.bmp"}, ".png"},
      {{"measure", box, "--picture", nowhere + ".png"}, "no folder"},
      {{"search", box, "--picture", folder / "box"}, ".png"},
      {{"map", box, "-o", nowhere + ".csv"}, "no folder"},
      {{"map", box, "-o", folder / "a", "--json", folder / "a"}, "same output"},
      {{"map", box, "-o", "-", "--json", "-"}, "same output"},
      {{"stack", box, "-o", "-"}, "file name"},
      {{"stack", box, "-o", folder / "stack.doc"}, ".3mf"},
      {{"stack", box, "-o", folder / "stack"}, ".3mf"},
      {{"stack", box, "-o", nowhere + ".obj"}, "no folder"},
      {{"inspect", box, "--json", "/dev/full"}, "/dev/full"},
  };
  for (const auto& [arguments, word] : cases) check_refused(folder, arguments, 2, word);
  CHECK(bytes_of(box) == bytes_of(folder.model("again.obj", solids::box({1, 2, 3}))));
}

TEST_CASE("no output replaces a file that the command reads, however it is spelled") {
  const BoxFolder folder;
  const std::string cup = folder.model("cup.obj", solids::box({9, 9, 1}));
  const std::string labels = folder.file("labels.txt", "a\na\na\na\na\na\nb\nb\nb\nb\nb\nb\n");
  const std::string detour = folder.path().string() + "/./" + "cup.obj", link = folder / "link.obj";
  std::filesystem::create_symlink(cup, link);
  const std::string cup_bytes = bytes_of(cup), label_bytes = bytes_of(labels);
  REQUIRE(run_program({"measure", folder.box, "--labels", labels}).status == 0);
  REQUIRE(run_program({"stack", folder.box, "--into", cup}).status == 0);
  for (const std::string& output : {cup, detour, link})
    for (const std::string option : {"-o", "--json"})
      check_refused(folder, {"stack", folder.box, "--into", cup, option, output}, 2, "replace the container");
  for (const std::string command : {"inspect", "measure", "search", "map", "stack", "validate", "structure"})
    check_refused(folder, {command, folder.box, "--labels", labels, "--json", labels}, 2,
                  "replace the labels");
  check_refused(folder, {"map", folder.box, "--labels", labels, "-o", labels}, 2, "replace the labels");
  CHECK(bytes_of(cup) == cup_bytes);
  CHECK(bytes_of(labels) == label_bytes);
}
