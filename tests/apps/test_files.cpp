#include <iostream>
#include <regex>
#include <set>

#include "apps/file_scenes.h"
#include "support/catch.h"
#include "support/solids.h"

using namespace stackabilization;
using namespace stackabilization::apps;

namespace {

namespace fs = std::filesystem;

/// Options that name what is read.
const std::set<std::string> inputs = {"--labels", "--seeds", "--ctrl", "--grp", "--into", "--onto"};

/// Kinds of values of options that are files or folders, and that are none; in choices there are no capitals.
const std::set<std::string> kinds_of_files = {"FILE", "FOLDER", "PROJECT", "CONTAINER"};
const std::set<std::string> other_kinds = {"N", "NUMBER", "LENGTH", "FRACTION", "X",
                                           "A", "PART",   "EDIT",   "NAME"};

/// Options of a command by the kind of their value, by its help.
std::map<std::string, std::set<std::string>> options_by_kind(const std::string& command) {
  const std::string help = run_program({command, "--help"}).out;
  const std::regex pattern("\n  (?:-[a-z],)?(--?[a-z-]+) ([A-Z]+)");
  std::map<std::string, std::set<std::string>> options;
  for (std::sregex_iterator match(help.begin(), help.end(), pattern), end; match != end; ++match)
    options[(*match)[2]].insert((*match)[1]);
  return options;
}

/// Those whose value is a file or a folder.
std::set<std::string> file_options(const std::string& command) {
  std::set<std::string> options;
  for (const auto& [kind, names] : options_by_kind(command))
    if (kinds_of_files.contains(kind)) options.insert(names.begin(), names.end());
  return options;
}

std::vector<std::string> commands_in_help() {
  const std::string help = run_program({"--help"}).out;
  const std::size_t start = help.find("Subcommands:"), stop = help.find("Example:");
  const std::string list = help.substr(start, stop - start);
  const std::regex pattern("\n  ([a-z]+) ");
  std::vector<std::string> names;
  for (std::sregex_iterator match(list.begin(), list.end(), pattern), end; match != end; ++match)
    names.push_back((*match)[1]);
  return names;
}

}  // namespace

TEST_CASE("the table of outputs has every option of every command that names a file or a folder") {
  std::map<std::string, std::set<std::string>> known;
  for (const Output& output : outputs()) known[output.command].insert(output.option);
  const std::vector<std::string> all = commands_in_help();
  CHECK(all.size() == known.size());
  for (const std::string& command : all) {
    INFO(command);
    std::set<std::string> options = file_options(command);
    std::erase_if(options, [](const std::string& option) { return inputs.contains(option); });
    CHECK(options == known[command]);
    for (const auto& [kind, names] : options_by_kind(command)) {
      INFO(kind);
      CHECK((kinds_of_files.contains(kind) || other_kinds.contains(kind)));
    }
  }
}

TEST_CASE("no output takes the place of a file that is read, whatever either is called") {
  for (const Output& output : outputs()) {
    if (output.extension.empty()) continue;
    std::set<std::string> read = file_options(output.command);
    std::erase_if(read, [](const std::string& option) { return !inputs.contains(option); });
    for (const auto& [name, same] : ways_to_be_the_same()) {
      INFO(name);
      Scene scene(output);
      const auto [mesh, written] = same(scene, output.extension);
      scene.check_refused(scene.line(mesh, written), "would replace the model");
      for (const std::string& input : read)
        scene.check_refused(scene.line(scene / "in.obj", written, input, mesh), "would replace the");
    }
  }
}

TEST_CASE("no folder is filled over a file that is read, whatever either is called") {
  for (const Output& output : outputs()) {
    if (!output.extension.empty()) continue;
    for (const std::string& name : names_in_folders().at(output.command))
      for (const auto& [way, lie] : ways_to_lie_in_a_folder()) {
        INFO(way << ": " << name);
        Scene scene(output);
        fs::create_directory(scene / "filled");
        const auto [mesh, written] = lie(scene, name);
        if (!mesh.ends_with(".json")) scene.check_refused(scene.line(mesh, written), "would replace");
        scene.check_refused(scene.line(scene / "in.obj", written, "--labels", mesh), "would replace");
      }
  }
}

TEST_CASE("what is in the way of a file is found before anything is computed") {
  for (const Output& output : outputs()) {
    if (output.extension.empty()) continue;
    const Scene scene(output);
    const std::string model = scene / "in.obj", ending = output.extension;
    fs::create_directory(scene / ("folder" + ending));
    scene.check_refused(scene.line(model, scene / ("folder" + ending)), "it is a folder");
    fs::permissions(scene.file("closed" + ending, "precious"), fs::perms::owner_read);
    scene.check_refused(scene.line(model, scene / ("closed" + ending)), "it is write-protected");
    fs::create_symlink("closed" + ending, scene / ("to_closed" + ending));
    scene.check_refused(scene.line(model, scene / ("to_closed" + ending)), "it is write-protected");
    fs::create_directory(scene / "shut");
    fs::permissions(scene / "shut", fs::perms::owner_read | fs::perms::owner_exec);
    scene.check_refused(scene.line(model, scene / ("shut/new" + ending)), "shut is write-protected");
    scene.check_refused(scene.line(model, scene / ("none/new" + ending)), "there is no folder");
    fs::create_symlink("none/new" + ending, scene / ("astray" + ending));
    scene.check_refused(scene.line(model, scene / ("astray" + ending)), "there is no folder");
    fs::create_symlink("circle" + ending, scene / ("circle" + ending));
    scene.check_refused(scene.line(model, scene / ("circle" + ending)), "in a circle");
    fs::permissions(scene / "shut", fs::perms::owner_all);
  }
}

TEST_CASE("what is in the way in a folder is found before anything is computed, and stays") {
  for (const Output& output : outputs()) {
    if (!output.extension.empty()) continue;
    for (const std::string& name : names_in_folders().at(output.command)) {
      const Scene scene(output);
      const std::string model = scene / "in.obj", folder = scene / "filled";
      fs::create_directory(folder);
      const Arguments line = scene.line(model, folder);
      CHECK(!scene.file("filled/" + name, "precious").empty());
      scene.check_refused(line, name + " is in the way");
      fs::permissions(folder + "/" + name, fs::perms::owner_read);
      scene.check_refused(line, "it is write-protected");
      fs::remove(folder + "/" + name);
      fs::create_directory(folder + "/" + name);
      scene.check_refused(line, name + " cannot be written: it is a folder");
      fs::remove(folder + "/" + name);
      fs::create_symlink("nowhere", folder + "/" + name);
      scene.check_refused(line, name + " cannot be written: it is a link");
    }
    const Scene scene(output);
    const std::string model = scene / "in.obj";
    fs::create_directory(scene / "shut");
    fs::permissions(scene / "shut", fs::perms::owner_read | fs::perms::owner_exec);
    scene.check_refused(scene.line(model, scene / "shut"), "shut is write-protected");
    scene.check_refused(scene.line(model, scene / "shut/new"), "shut is write-protected");
    scene.check_refused(scene.line(model, scene.file("file", "precious")), "not a folder");
    scene.check_refused(scene.line(model, scene / "file/new"), "not a folder");
    fs::create_symlink("nowhere", scene / "astray");
    scene.check_refused(scene.line(model, scene / "astray"), "not a folder");
    for (const char* name : {"relations.csv", "solutions.OBJ", "page.html/"})
      scene.check_refused(scene.line(model, scene / name), "called like a file");
    fs::permissions(scene / "shut", fs::perms::owner_all);
  }
}

TEST_CASE("no two outputs of a command are one file") {
  for (const Output& first : outputs())
    for (const Output& second : outputs()) {
      if (first.command != second.command || first.extension.empty() || second.extension != ".json" ||
          first.option == second.option)
        continue;
      const Scene scene(first);
      fs::create_symlink("two" + first.extension, scene / "two_as.json");
      scene.check_refused(joined(scene.line(scene / "in.obj", scene / ("two" + first.extension)),
                                 {second.option, scene / "two_as.json"}),
                          "name the same output");
    }
  const Scene scene({"improve", "--output", "", {"--target", "0.6"}});
  fs::create_directory(scene / "filled");
  for (const char* name : {"index.html", "solution_3.obj", "stackabilize-files.json"})
    for (const std::string folder : {"filled", "new"})
      scene.check_refused(
          joined(scene.line(scene / "in.obj", scene / folder), {"--json", scene / (folder + "/" + name)}),
          "would replace what --json writes");
}

TEST_CASE("standard input and output are files as well") {
  const Scene scene({"inspect", "--json", ".json"});
  const std::string program = STACKABILIZATION_PROGRAM, model = scene / "in.obj";
  const auto status = [](const std::string& command) { return std::system(command.c_str()) / 256; };
  CHECK(status(program + " inspect - --format obj --json " + model + " <" + model + " 2>/dev/null") == 2);
  CHECK(status(program + " inspect " + model + " >>" + model + " 2>/dev/null") == 2);
  CHECK(status(program + " inspect " + model + " --json - >>" + model + " 2>/dev/null") == 2);
  CHECK(bytes_of(model) == scene.bytes);
  CHECK(status(program + " inspect " + model + " --json /dev/null >/dev/null") == 0);
  CHECK(status("cat " + model + " | " + program + " inspect - --format obj --json /dev/stdout >/dev/null") ==
        0);
}

TEST_CASE("files that the model refers to are read too") {
  const TemporaryFolder folder;
  const std::string chair =
      folder.file("chair.obj", "mtllib my paint.json\nmtllib a.json b.json\n" +
                                   bytes_of(folder.model("in.obj", solids::box({1, 1, 1}))));
  for (const char* name : {"my paint.json", "a.json", "b.json"}) {
    CHECK(!folder.file(name, "precious").empty());
    check_refused(folder, {"inspect", chair, "--json", folder / name}, 2,
                  "would replace a file of the model");
  }
  const std::string scene = folder.file("scene.gltf", R"({"asset": {"version": "2.0"},
      "buffers": [{"uri": "my%20buffer.json", "byteLength": 8}], "images": [{"uri": "wood.json"}]})");
  for (const char* name : {"my buffer.json", "wood.json"}) {
    CHECK(!folder.file(name, "precious").empty());
    check_refused(folder, {"inspect", scene, "--json", folder / name}, 2,
                  "would replace a file of the model");
    check_refused(folder, {"stack", folder / "in.obj", "--into", scene, "--json", folder / name}, 2,
                  "would replace a file of the container");
  }
}

TEST_CASE("an output that is a link writes what it leads to, be it there or not") {
  const TemporaryFolder folder;
  const std::string model = folder.model("in.obj", solids::box({1, 1, 1}));
  fs::create_directory(folder / "far");
  for (const bool exists : {false, true}) {
    if (exists) CHECK(!folder.file("far/out.json", "old").empty());
    fs::remove(folder / "link.json");
    fs::create_symlink("far/out.json", folder / "link.json");
    REQUIRE(run_program({"inspect", model, "--json", folder / "link.json"}).status == 0);
    CHECK(fs::is_symlink(folder / "link.json"));
    CHECK(nlohmann::json::parse(bytes_of(folder / "far/out.json"))["command"] == "inspect");
    fs::remove(folder / "far/out.json");
  }
}

TEST_CASE("a session updates its project in place, but for a protected one") {
  const TemporaryFolder folder;
  const std::string table = folder.model("table.obj", solids::table({})), project = folder / "table.json";
  REQUIRE(run_program({"structure", table, "--save", project}).status == 0);
  const std::string before = bytes_of(project);
  check_refused(folder, {"suggest", project, "--apply", "1", "--json", project}, 2,
                "would replace the model");
  fs::permissions(project, fs::perms::owner_read);
  check_refused(folder, {"suggest", project, "--apply", "1"}, 2, "write-protected");
  fs::permissions(project, fs::perms::owner_read | fs::perms::owner_write);
  CHECK(bytes_of(project) == before);
  fs::create_symlink("table.json", folder / "link.json");
  CHECK(run_program({"suggest", folder / "link.json", "--apply", "1"}).status == 0);
  CHECK(fs::is_symlink(folder / "link.json"));
  CHECK(bytes_of(project) != before);
}

TEST_CASE("a full device is found before anything is computed") {
  const TemporaryFolder folder;
  const std::string model = folder.model("in.obj", solids::box({1, 1, 1})), full = folder / "full";
  fs::create_directory(full);
  // A device of one page, filled, in a name space of its own.
  const std::string filled =
      "mount -t tmpfs -o size=4k tmpfs '" + full + "' && head -c 4096 /dev/zero >'" + full + "/all' && ";
  if (std::system(("unshare -rm sh -c \"" + filled + "true\" 2>/dev/null").c_str()) != 0) {
    std::cout << "SKIPPED: no name space for a device of one page\n";
    return;
  }
  const std::string line = filled + std::string(STACKABILIZATION_PROGRAM) + " inspect '" + model +
                           "' --json '" + full + "/out.json' 2>'" + folder.path().string() + "/err'";
  CHECK(std::system(("unshare -rm sh -c \"" + line + "\"").c_str()) / 256 == 2);
  CHECK(bytes_of(folder / "err").find("no room left") != std::string::npos);
}
