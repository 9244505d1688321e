// Question: what does each command of the program cost on many parts and on many triangles?
//
//     command_costs [--largest-parts N] [--largest-triangles N] [--limit SECONDS] [--command NAME ...]
//                   [--threads N] [-o FOLDER]
//
// Parts: grids of touching cubes, racks of bars between two posts, and cubes that are all in one place, of
// 10, 100, 1,000 ... parts. Triangles: a thin-walled cup with a wavy wall of 1,000, 10,000 ... triangles.
// Every command of the program, or those that --command names, is run on every one of them as a user would
// run it, in a process of its own. Where a command asks for a second model, it is the same one.
//
// One row per model and command: exit status, processor and elapsed seconds, and most megabytes held at once.
// `said` is what the program answered when it did not end with status 0 or 1. A command that uses more
// processor time than --limit is stopped, and its row has status 152; larger models of the kind are not tried
// with it.

#include <unistd.h>

#include <algorithm>
#include <cstdint>
#include <set>

#include "common/child_process.h"
#include "common/experiment.h"
#include "common/generated_models.h"
#include "stackabilization/core/errors.h"
#include "stackabilization/io/write.h"

using namespace stackabilization;
using namespace stackabilization::experiments;

namespace fs = std::filesystem;

namespace {

struct Settings {
  int max_parts = 10000, max_triangles = 1000000, limit = 60;
  std::vector<std::string> commands;  ///< those to run; all when empty
};

/// A folder of its own, gone with the object.
class TemporaryFolder {
 public:
  TemporaryFolder() {
    std::string name = (fs::temp_directory_path() / "command_costs-XXXXXX").string();
    if (!mkdtemp(name.data())) throw OutputError("no temporary folder can be made");
    path_ = name;
  }
  ~TemporaryFolder() {
    std::error_code ignored;
    fs::remove_all(path_, ignored);
  }
  TemporaryFolder(const TemporaryFolder&) = delete;
  TemporaryFolder& operator=(const TemporaryFolder&) = delete;

  const fs::path& path() const { return path_; }

 private:
  fs::path path_;
};

/// A kind of model that comes in all sizes.
struct Family {
  std::string name;
  Shape (*make)(int size);
  int smallest, largest;
};

/// What comes after the model on a command line; FOLDER stands for a folder of its own.
struct CommandLine {
  std::string command;
  std::vector<std::string> options;
};

const std::vector<CommandLine>& command_lines() {
  static const std::vector<CommandLine> lines = {
      {"inspect", {}},
      {"measure", {"--direction", "0", "0", "1"}},
      {"search", {}},
      {"map", {"--step-degrees", "10", "-o", "FOLDER/map.csv"}},
      {"stack", {"--direction", "0", "0", "1", "-n", "10"}},
      {"hold", {"--direction", "0", "0", "1", "-n", "10"}},
      {"gap", {"FOLDER/model.obj", "--direction", "0", "0", "1"}},
      {"drop", {"--onto", "FOLDER/model.obj", "--direction", "0", "0", "1"}},
      {"items", {"--unit", "cm"}},
      {"draft", {"--direction", "0", "0", "1"}},
      {"validate", {"--direction", "0", "0", "1"}},
      {"structure", {}},
      {"deform", {"--edit", "FIRST scale 1.01"}},
      {"suggest", {"--direction", "0", "0", "1"}},
      {"improve",
       {"--direction", "0", "0", "1", "--target", "0.5", "--time", "10", "--no-pictures", "-o",
        "FOLDER/designs"}},
      {"compare", {"FOLDER/model.obj"}},
  };
  return lines;
}

/// `word` with what stands in it for the folder and for the first part of the model.
std::string filled(std::string word, const fs::path& folder, const Shape& shape) {
  for (const auto& [mark, text] :
       {std::pair<std::string, std::string>{"FOLDER", folder.string()}, {"FIRST", shape.part_names.front()}})
    if (const std::size_t place = word.find(mark); place != std::string::npos)
      word.replace(place, mark.size(), text);
  return word;
}

class CommandCosts {
 public:
  CommandCosts(const Settings& settings, int threads, Report& report)
      : settings_(settings),
        threads_(threads),
        table_(report.table("", {{"model", ColumnKind::key},
                                 {"parts", ColumnKind::key},
                                 {"triangles", ColumnKind::key},
                                 {"command", ColumnKind::key},
                                 {"status", ColumnKind::clock},
                                 {"cpu_seconds", ColumnKind::clock},
                                 {"seconds", ColumnKind::clock},
                                 {"megabytes", ColumnKind::clock},
                                 {"said", ColumnKind::clock}})) {}

  void run() {
    constexpr int min_parts = 10, min_triangles = 1000;
    for (const Family& family : {Family{"cubes", cube_grid, min_parts, settings_.max_parts},
                                 Family{"rack", rack, min_parts, settings_.max_parts},
                                 Family{"coincident cubes", coincident_cubes, min_parts, settings_.max_parts},
                                 Family{"cup", wavy_cup, min_triangles, settings_.max_triangles}})
      measure(family);
  }

 private:
  void measure(const Family& family) {
    std::set<std::string> stopped;
    for (std::int64_t size = family.smallest; size <= family.largest; size *= 10) {
      const Shape shape = family.make(static_cast<int>(size));
      const TemporaryFolder folder;
      write_shape(shape, folder.path() / "model.obj");
      for (const CommandLine& line : command_lines())
        if (is_wanted(line.command) && !stopped.contains(line.command) &&
            !add(family.name, shape, line, folder.path()))
          stopped.insert(line.command);
    }
  }

  bool is_wanted(const std::string& command) const {
    const std::vector<std::string>& wanted = settings_.commands;
    return wanted.empty() || std::find(wanted.begin(), wanted.end(), command) != wanted.end();
  }

  /// Did the command end by itself?
  bool add(const std::string& family, const Shape& shape, const CommandLine& line, const fs::path& folder) {
    ChildProcess child{{STACKABILIZATION_PROGRAM, line.command, (folder / "model.obj").string(), "--threads",
                        std::to_string(threads_), "--quiet"},
                       folder / "said",
                       settings_.limit};
    for (const std::string& option : line.options) child.words.push_back(filled(option, folder, shape));
    const ChildOutcome outcome = run_child(child);
    const bool answered = outcome.status == 0 || outcome.status == 1 || outcome.killed();
    std::string said = answered ? "" : first_line(child.log);
    if (const std::size_t place = said.find(folder.string() + "/"); place != std::string::npos)
      said.erase(place, folder.string().size() + 1);
    table_.add({family, std::int64_t{shape.part_count()}, std::int64_t{shape.triangle_count()}, line.command,
                std::int64_t{outcome.status}, outcome.processor_seconds, outcome.seconds, outcome.megabytes,
                said});
    return !outcome.killed();
  }

  const Settings& settings_;
  int threads_;
  Table& table_;
};

}  // namespace

int main(int argc, char** argv) {
  Experiment experiment("command_costs", "What does each command cost on many parts and on many triangles?",
                        Inputs::none);
  Settings settings;
  experiment.app()
      .add_option("--largest-parts", settings.max_parts, "parts of the largest models")
      ->check(CLI::Range(10, 100000));
  experiment.app()
      .add_option("--largest-triangles", settings.max_triangles, "triangles of the largest cup")
      ->check(CLI::Range(1000, 10000000));
  experiment.app()
      .add_option("--limit", settings.limit, "processor seconds after which a command is stopped")
      ->check(CLI::Range(1, 86400));
  std::vector<std::string> names;
  for (const CommandLine& line : command_lines()) names.push_back(line.command);
  experiment.app()
      .add_option("--command", settings.commands, "command to run, repeatable (default: all)")
      ->check(CLI::IsMember(names));
  return experiment.run(argc, argv,
                        [&](Report& report) { CommandCosts(settings, experiment.threads(), report).run(); });
}
