#include <algorithm>
#include <functional>
#include <iostream>
#include <map>
#include <regex>
#include <set>

#include "apps/run_program.h"
#include "support/catch.h"
#include "support/solids.h"

using namespace stackabilization;
using namespace stackabilization::apps;

namespace {

namespace fs = std::filesystem;
using Arguments = std::vector<std::string>;

Arguments joined(Arguments a, const Arguments& b) {
  a.insert(a.end(), b.begin(), b.end());
  return a;
}

/// An option that names what is written, and the rest of a command line that gets as far as looking at files.
struct Output {
  std::string command, option, extension;  ///< of a file; empty: a folder
  Arguments further = {};
};

/// Options that name what is read.
const std::set<std::string> inputs = {"--labels", "--seeds", "--ctrl", "--grp", "--into"};

const std::vector<Output>& outputs() {
  static const std::vector<Output> all = {
      {"inspect", "--json", ".json"},
      {"measure", "--json", ".json"},
      {"measure", "--picture", ".png"},
      {"search", "--json", ".json"},
      {"search", "--picture", ".png"},
      {"map", "--json", ".json"},
      {"map", "--output", ".csv"},
      {"map", "--picture", ".svg"},
      {"stack", "--json", ".json"},
      {"stack", "--output", ".3mf"},
      {"stack", "--picture", ".png"},
      {"validate", "--json", ".json"},
      {"structure", "--json", ".json"},
      {"structure", "--save", ".json"},
      {"structure", "--graph", ".dot"},
      {"structure", "--picture", ".png"},
      {"deform", "--json", ".json", {"--edit", "shape scale 0.9"}},
      {"deform", "--output", ".obj", {"--edit", "shape scale 0.9"}},
      {"deform", "--save", ".json", {"--edit", "shape scale 0.9"}},
      {"deform", "--picture", ".png", {"--edit", "shape scale 0.9"}},
      {"suggest", "--json", ".json"},
      {"suggest", "--save", ".json"},
      {"suggest", "--pictures", ""},
      {"improve", "--json", ".json", {"--target", "0.6", "--output", "elsewhere"}},
      {"improve", "--output", "", {"--target", "0.6"}}};
  return all;
}

/// Options of a command whose value is a file or a folder, by its help.
std::set<std::string> file_options(const std::string& command) {
  const std::string help = run_program({command, "--help"}).out;
  const std::regex pattern("\n  (?:-[a-z],)?(--[a-z-]+) (?:FILE|FOLDER|PROJECT|CONTAINER)");
  std::set<std::string> options;
  for (std::sregex_iterator match(help.begin(), help.end(), pattern), end; match != end; ++match)
    options.insert((*match)[1]);
  return options;
}

std::vector<std::string> commands() {
  const std::string help = run_program({"--help"}).out;
  const std::size_t start = help.find("Subcommands:"), stop = help.find("Example:");
  const std::string list = help.substr(start, stop - start);
  const std::regex pattern("\n  ([a-z]+) ");
  std::vector<std::string> names;
  for (std::sregex_iterator match(list.begin(), list.end(), pattern), end; match != end; ++match)
    names.push_back((*match)[1]);
  return names;
}

/// All that is below a folder: what links lead to, rights and bytes.
std::map<std::string, std::string> contents(const fs::path& folder) {
  std::map<std::string, std::string> all;
  for (const auto& entry : fs::recursive_directory_iterator(folder)) {
    std::string& what = all[entry.path().string()];
    if (entry.is_symlink())
      what = "link to " + fs::read_symlink(entry.path()).string();
    else
      what = std::to_string(static_cast<int>(entry.status().permissions())) +
             (entry.is_directory() ? " folder" : bytes_of(entry.path().string()));
  }
  return all;
}

/// A folder with the files of one command line.
struct Scene : TemporaryFolder {
  explicit Scene(const Output& output)
      : what(output), bytes(bytes_of(model("in.obj", solids::box({1, 1, 1})))) {}

  /// The command line that reads `mesh`, and by `input` the file `read`, and writes `written`.
  Arguments line(const std::string& mesh, const std::string& written, const std::string& input = "",
                 const std::string& read = "") const {
    Arguments arguments = {what.command, mesh, what.option, written};
    // Whatever it is called; a name that ends in .json is that of a project all the same.
    if (!mesh.ends_with(".json")) arguments = joined(arguments, {"--format", "obj"});
    arguments = joined(arguments, what.further);
    for (std::string& argument : arguments)
      if (argument == "elsewhere") argument = *this / "elsewhere";
    return input.empty() ? arguments : joined(arguments, {input, read});
  }

  void check_refused(const Arguments& arguments, const std::string& words) const {
    std::string text;
    for (const std::string& argument : arguments) text += argument + " ";
    INFO(text);
    const auto before = contents(path());
    const Outcome outcome = run_program(arguments);
    INFO(outcome.err);
    CHECK(outcome.status == 2);
    CHECK(outcome.out.empty());
    CHECK(is_one_sentence(outcome.err));
    CHECK(std::regex_search(outcome.err, std::regex(words)));
    CHECK(contents(path()) == before);
  }

  Output what;
  std::string bytes;
};

/// Ways in which a file that is read and one that is written can be the same. Each makes files in the folder,
/// of which `own` is a name with this ending, and returns what is read and what is written.
using Same = std::function<std::pair<std::string, std::string>(const Scene&, const std::string& ending)>;
const std::map<std::string, Same>& ways_to_be_the_same() {
  static const std::map<std::string, Same> ways = {
      {"the same name",
       [](const Scene& scene, const std::string& ending) {
         const std::string file = scene.file("own" + ending, scene.bytes);
         return std::pair(file, file);
       }},
      {"through ..",
       [](const Scene& scene, const std::string& ending) {
         const std::string file = scene.file("own" + ending, scene.bytes);
         fs::create_directory(scene / "sub");
         return std::pair(file, scene / ("sub/../own" + ending));
       }},
      {"a symbolic link to what is read",
       [](const Scene& scene, const std::string& ending) {
         const std::string file = scene.file("own" + ending, scene.bytes);
         fs::create_symlink("own" + ending, scene / ("link" + ending));
         return std::pair(file, scene / ("link" + ending));
       }},
      {"a symbolic link to what is written",
       [](const Scene& scene, const std::string& ending) {
         const std::string file = scene.file("own" + ending, scene.bytes);
         fs::create_symlink("own" + ending, scene / ("link" + ending));
         return std::pair(scene / ("link" + ending), file);
       }},
      {"a hard link",
       [](const Scene& scene, const std::string& ending) {
         const std::string file = scene.file("own" + ending, scene.bytes);
         fs::create_hard_link(file, scene / ("link" + ending));
         return std::pair(file, scene / ("link" + ending));
       }},
      {"through a folder that is a link",
       [](const Scene& scene, const std::string& ending) {
         const std::string file = scene.file("own" + ending, scene.bytes);
         fs::create_directory_symlink(".", scene / "alias");
         return std::pair(file, scene / ("alias/own" + ending));
       }},
      {"a dangling link, and the name that it leads to",
       [](const Scene& scene, const std::string& ending) {
         fs::create_symlink("own" + ending, scene / ("link" + ending));
         return std::pair(scene / ("own" + ending), scene / ("link" + ending));
       }},
      {"a temporary name of what is written", [](const Scene& scene, const std::string& ending) {
         return std::pair(scene.file("own" + ending + ".999999999.tmp", scene.bytes),
                          scene / ("own" + ending));
       }}};
  return ways;
}

/// The same for files in a folder that a command fills, one of whose names is `name`.
const std::map<std::string, Same>& ways_to_lie_in_a_folder() {
  static const std::map<std::string, Same> ways = {
      {"a name of the command",
       [](const Scene& scene, const std::string& name) {
         return std::pair(scene.file("filled/" + name, scene.bytes), scene / "filled");
       }},
      {"a link to what is read, there",
       [](const Scene& scene, const std::string& name) {
         fs::create_symlink("../in.obj", scene / ("filled/" + name));
         return std::pair(scene / "in.obj", scene / "filled");
       }},
      {"a hard link there",
       [](const Scene& scene, const std::string& name) {
         fs::create_hard_link(scene / "in.obj", scene / ("filled/" + name));
         return std::pair(scene / "in.obj", scene / "filled");
       }},
      {"a link to a name of the command",
       [](const Scene& scene, const std::string& name) {
         CHECK(!scene.file("filled/" + name, scene.bytes).empty());
         fs::create_symlink("filled/" + name, scene / "link.obj");
         return std::pair(scene / "link.obj", scene / "filled");
       }},
      {"through a folder that is a link",
       [](const Scene& scene, const std::string& name) {
         fs::create_directory_symlink("filled", scene / "alias");
         return std::pair(scene.file("filled/" + name, scene.bytes), scene / "alias");
       }},
      {"a temporary name", [](const Scene& scene, const std::string& name) {
         return std::pair(scene.file("filled/" + name + ".999999999.tmp", scene.bytes), scene / "filled");
       }}};
  return ways;
}

const std::map<std::string, std::vector<std::string>>& names_in_folders() {
  static const std::map<std::string, std::vector<std::string>> names = {
      {"improve",
       {"index.html", "result.json", "solutions.stackabilize.json", "search-state.json", "solution_1.obj",
        "solution_12.3mf", "nearest.json", "nearest.stackabilize.json", "solution_3_stack.png",
        "solution_2_before_after.png", "stackabilize-files.json"}},
      {"suggest", {"suggestions.png", "suggestion_1.png", "suggestion_40.png", "stackabilize-files.json"}}};
  return names;
}

}  // namespace

TEST_CASE("the table of outputs has every option of every command that names a file or a folder") {
  std::map<std::string, std::set<std::string>> known;
  for (const Output& output : outputs()) known[output.command].insert(output.option);
  const std::vector<std::string> all = commands();
  CHECK(all.size() == known.size());
  for (const std::string& command : all) {
    INFO(command);
    std::set<std::string> options = file_options(command);
    std::erase_if(options, [](const std::string& option) { return inputs.contains(option); });
    CHECK(options == known[command]);
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
