#include <cmath>

#include "apps/run_program.h"
#include "support/catch.h"
#include "support/solids.h"

using namespace stackabilization;
using namespace stackabilization::apps;
using nlohmann::json;

namespace {

/// Brick that does not nest, and cup that does, in one folder; a text file is beside them.
struct ItemsFolder : TemporaryFolder {
  std::string brick = model("b,rick.obj", solids::box({0, 0, 0}, {2, 3, 1.5}));
  std::string cup = model("cup.obj", solids::frustum_shell({}));
  std::string other = file("notes.txt", "no mesh");
  std::string path() const { return std::filesystem::path(cup).parent_path().string(); }
};

}  // namespace

TEST_CASE("the item table has a row per mesh of a folder, by name, for planners that split at commas") {
  const ItemsFolder folder;
  const Outcome outcome = run_program({"items", folder.path(), "--step", "0.5", "--copies", "40", "-o", "-"});
  CHECK(outcome.status == 0);
  CHECK(outcome.out ==
        "X,Y,Z,COPIES,ROTATION_XYZ,ROTATION_YXZ,ROTATION_ZYX,ROTATION_YZX,ROTATION_XZY,ROTATION_ZXY,"
        "STACKABILITY_ID,NESTING_HEIGHT,INCREMENT,NAME\n"
        "6,4,3,40,1,1,0,0,0,0,0,0,3,b_rick.obj\n"
        "16,16,16,40,1,1,0,0,0,0,1,7,9,cup.obj\n");
  const json document = run_program({"items", folder.path(), "--step", "0.5", "--json", "-"}).json();
  REQUIRE(document["items"].size() == 2);
  CHECK(document["items"][0]["model"] == folder.brick);
  CHECK(document["items"][1]["nesting_height"] == 7);
  CHECK(document["items"][1]["increment"] == 9);
}

TEST_CASE("a whole unit of the item table is a millimetre of each mesh") {
  const TemporaryFolder folder;
  Shape inches = solids::box({1, 2, 3}), metres = inches;
  inches.unit = Unit::inch;
  metres.unit = Unit::metre;
  const std::string in_inches = folder.model("a.3mf", inches), in_metres = folder.model("b.glb", metres);
  const json items = run_program({"items", in_inches, in_metres, "--json", "-"}).json()["items"];
  CHECK(items[0]["length"] == 51);  // 50.8
  CHECK(items[0]["height"] == 77);  // 76.2
  CHECK(items[1]["length"] == 2000);
  CHECK(items[1]["height"] == 3000);
}

TEST_CASE("items are measured along the direction given, with air and play as stacks are") {
  const ItemsFolder folder;
  const auto item = [&](const std::string& path, const Arguments& options) {
    return run_program(joined({"items", path, "--step", "0.5", "--json", "-"}, options)).json()["items"][0];
  };
  const json lying = item(folder.brick, {"--direction", "1", "0", "0"});
  CHECK(lying["length"] == 6);
  CHECK(lying["width"] == 3);
  CHECK(lying["height"] == 4);
  for (const Arguments& options : {Arguments{"--clearance", "0.7"}, Arguments{"--lateral-clearance", "0.1"},
                                   Arguments{"--direction", "0.3", "0", "1"}}) {
    const json stack = run_program(joined({"stack", folder.cup, "--json", "-"}, options)).json();
    const double increment = stack["nesting_increment"].get<double>();
    CHECK(item(folder.cup, options)["increment"] == static_cast<int>(std::ceil(increment / 0.5 - 1e-9)));
    CHECK(item(folder.cup, options)["increment"] > item(folder.cup, {})["increment"]);
  }
}

TEST_CASE("sizes that no object has are questioned below the item table") {
  const ItemsFolder folder;
  const auto text = [&](const std::string& unit) {
    return run_program({"items", folder.cup, folder.brick, "--unit", unit}).out;
  };
  const auto has = [](const std::string& whole, const std::string& part) {
    return whole.find(part) != std::string::npos;
  };
  CHECK(has(text("mm"), ", an unlikely size: are these numbers "));
  CHECK(has(text("mm"), "\nb,rick.obj: "));
  CHECK_FALSE(has(text("m"), "unlikely"));
}

TEST_CASE("an item table is refused where its numbers would have no meaning, and nothing is written") {
  const ItemsFolder folder;
  check_refused(folder, {"items", folder.cup, "-o", folder / "items.csv"}, 2, "--unit");
  check_refused(folder, {"items", folder.cup, "--step", "1e-30", "-o", folder / "items.csv"}, 2, "--step");
  check_refused(folder, {"items", folder.cup, "--step", "0"}, 2, "--step");
  check_refused(folder, {"items", folder.cup, folder.brick, "--format", "obj", "--unit", "m"}, 2, "--format");
  check_refused(folder, {"items", folder.cup, folder / "missing.obj", "--unit", "m"}, 3, "missing.obj");
  check_refused(folder, {"items", folder.other, "--unit", "m"}, 3, "notes.txt");
  check_refused(folder, {"items", "-", "-", "--unit", "m"}, 2, "standard input once");
  check_refused(folder, {"items", folder.path(), "--unit", "m", "-o", folder.cup}, 2, "would replace");
  const std::string sheet = folder.model("sheet.obj", solids::box({0, 0, 0}, {2, 3, 0}));
  check_refused(folder, {"items", sheet, "--unit", "m"}, 3, "give its thickness as --clearance");
  check_refused(folder, {"items", sheet, "--unit", "m", "--direction", "1", "0", "0"}, 3, "no area");
  CHECK(run_program({"items", sheet, "--unit", "m", "--clearance", "2mm"}).status == 0);
  std::filesystem::remove(sheet);
  std::filesystem::create_directory(folder / "empty");
  check_refused(folder, {"items", folder / "empty", "--unit", "m"}, 3, "expected a folder with meshes");
  std::filesystem::copy_file(folder.cup, folder / "odd\xff.obj");
  check_refused(folder, {"items", folder.path(), "--unit", "m"}, 3, "UTF-8");
}
