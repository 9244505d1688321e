#include "apps/file_scenes.h"

#include <algorithm>
#include <iterator>
#include <regex>

#include "support/catch.h"
#include "support/solids.h"

namespace stackabilization::apps {

namespace {

namespace fs = std::filesystem;

/// All that is below a folder: what links lead to, rights and bytes.
std::map<std::string, std::string> everything_below(const fs::path& folder) {
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

}  // namespace

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
      {"hold", "--json", ".json"},
      {"gap", "--json", ".json", {"after.obj"}},
      {"items", "--json", ".json", {"--unit", "m"}},
      {"items", "--output", ".csv", {"--unit", "m"}},
      {"draft", "--json", ".json"},
      {"draft", "--output", ".csv"},
      {"draft", "--picture", ".png"},
      {"drop", "--json", ".json", {"--onto", "after.obj"}},
      {"drop", "--output", ".3mf", {"--onto", "after.obj"}},
      {"drop", "--map", ".csv", {"--onto", "after.obj"}},
      {"drop", "--picture", ".png", {"--onto", "after.obj"}},
      {"validate", "--json", ".json"},
      {"structure", "--json", ".json"},
      {"structure", "--save", ".json"},
      {"structure", "--graph", ".dot"},
      {"structure", "--output", ".obj"},
      {"structure", "--picture", ".png"},
      {"deform", "--json", ".json", {"--edit", "shape scale 0.9"}},
      {"deform", "--output", ".obj", {"--edit", "shape scale 0.9"}},
      {"deform", "--save", ".json", {"--edit", "shape scale 0.9"}},
      {"deform", "--picture", ".png", {"--edit", "shape scale 0.9"}},
      {"suggest", "--json", ".json"},
      {"suggest", "--save", ".json"},
      {"suggest", "--pictures", ""},
      {"edit", "--json", ".json"},
      {"edit", "--session", ".json"},
      {"edit", "--study", ".csv"},
      {"compare", "--json", ".json", {"after.obj"}},
      {"improve", "--json", ".json", {"--target", "0.6", "--output", "elsewhere"}},
      {"improve", "--output", "", {"--target", "0.6"}}};
  return all;
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

Scene::Scene(const Output& output) : what(output), bytes(bytes_of(model("in.obj", solids::box({1, 1, 1})))) {}

Arguments Scene::line(const std::string& mesh, const std::string& written, const std::string& input,
                      const std::string& read) const {
  Arguments arguments = {what.command, mesh, what.option, written};
  // Whatever it is called; a name that ends in .json is that of a project all the same.
  if (!mesh.ends_with(".json")) arguments = joined(arguments, {"--format", "obj"});
  arguments = joined(arguments, what.further);
  for (std::string& argument : arguments)
    if (argument == "elsewhere") argument = *this / "elsewhere";
  if (input.empty()) return arguments;
  const auto given = std::find(arguments.begin(), arguments.end(), input);
  if (given == arguments.end()) return joined(arguments, {input, read});
  *std::next(given) = read;
  return arguments;
}

void Scene::check_refused(const Arguments& arguments, const std::string& words) const {
  std::string text;
  for (const std::string& argument : arguments) text += argument + " ";
  INFO(text);
  const auto before = everything_below(path());
  const Outcome outcome = run_program(arguments);
  INFO(outcome.err);
  CHECK(outcome.status == 2);
  CHECK(outcome.out.empty());
  CHECK(is_one_sentence(outcome.err));
  CHECK(std::regex_search(outcome.err, std::regex(words)));
  CHECK(everything_below(path()) == before);
}

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

}  // namespace stackabilization::apps
