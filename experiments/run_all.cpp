// Runs every experiment, one after the other, into one folder.
//
//     run_all -o FOLDER [--paper-data FOLDER] [--segmentation-benchmark FOLDER] [--quick] [--threads N]
//             [--only NAME...]
//
// An experiment is skipped when an earlier run of the same program, with the same options and inputs, came to
// its end and its outputs are unchanged; so a run that was killed goes on where it was. One that fails is
// reported and the next follows. What each one says goes to FOLDER/NAME.log. Exit status 0: all done; 1: some
// failed, or found that the answer to their question is no; 2: wrong usage, or the folder cannot be written;
// 3: an input folder cannot be used.

#include <tbb/info.h>
#include <unistd.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <iostream>

#include "common/child_process.h"
#include "common/clock.h"
#include "common/models.h"
#include "common/resume.h"
#include "stackabilization/core/errors.h"
#include "stackabilization/io/file_plan.h"

using namespace stackabilization;
using namespace stackabilization::experiments;

namespace fs = std::filesystem;

namespace {

struct Settings {
  fs::path output, paper_data, benchmark;
  bool quick = false;
  int threads = tbb::info::default_concurrency();
  std::vector<std::string> only;
};

/// What an experiment is given besides its own options.
struct Kind {
  bool models = true;             ///< the shipped models, or a few of them when it must be quick
  bool own_choice = false;        ///< it takes no models, but reads shipped ones
  bool paper_data = true;         ///< the authors' data, when there are any
  bool needs_paper_data = false;  ///< nothing to do without them
  bool needs_benchmark = false;   ///< nothing to do without a benchmark of segmentations
  bool threads = true;
};

struct Entry {
  std::string name;
  Kind kind;
  std::vector<std::string> options, quick_options;
  std::vector<std::string> only_models = {};  ///< of the shipped ones; empty: all

  bool takes(const std::string& model) const {
    return only_models.empty() ||
           std::find(only_models.begin(), only_models.end(), model) != only_models.end();
  }
};

const std::vector<Entry>& entries() {
  static const std::vector<Entry> all = {
      {"envelope_accuracy", {}, {}, {"--directions", "3", "--fine-directions", "0"}},
      {"direction_search", {}, {}, {"--largest", "1000", "--seeds", "1", "--max-cells", "100"}},
      {"place_accuracy", {}, {}, {"--cells", "30"}},
      {"minimal_translation", {.threads = false}, {}, {"--directions", "10", "--slow-directions", "1"}},
      {"scaling",
       {.models = false, .paper_data = false},
       {},
       {"--largest-triangles", "9000", "--largest-parts", "16", "--directions", "10", "--finest-spacing",
        "0.32"}},
      {"command_costs",
       {.models = false, .paper_data = false},
       {},
       {"--largest-parts", "10", "--largest-triangles", "1000"}},
      {"deformation_speed", {.paper_data = false, .threads = false}, {}, {"--edits", "20"}},
      {"relations_against_lists", {.models = false, .needs_paper_data = true}, {}, {}},
      {"segmentation_quality", {.models = false, .paper_data = false, .needs_benchmark = true}, {}, {}},
      {"refined_against_paper", {.paper_data = false}, {}, {"--expansions", "3"}},
      {"design_quality", {}, {}, {"--gain", "0.1", "--effort", "0.05"}},
      {"authors_designs", {.models = false, .needs_paper_data = true}, {}, {"--effort", "0.05"}},
      {"study",
       {.models = false, .own_choice = true},
       {},
       {"--seeds", "3", "--edits", "30", "--expansions", "2", "cup", "cup-handle"}},
      {"deformation_models",
       {.paper_data = false},
       {},
       {"--targets", "0.2", "--alphas", "0.1,0.8", "--expansions", "2", "--evaluations", "20",
        "--deformations", "cuboids,mixed"},
       {"cup", "mug_with_handle", "table"}},
  };
  return all;
}

void add_paper_data(const fs::path& folder, Job& job) {
  job.arguments.insert(job.arguments.end(), {"--paper-data", folder.string()});
  for (const char* extension : {".obj", ".grp", ".ctrl", ".seg", ".txt"})
    for (const fs::path& file : files_below(folder, extension)) job.inputs.push_back(file);
}

void add_benchmark(const fs::path& folder, Job& job) {
  job.arguments.push_back(folder.string());
  for (const char* extension : {".off", ".seg"})
    for (const fs::path& file : files_below(folder / "data", extension)) job.inputs.push_back(file);
}

void add_models(const Entry& entry, bool quick, Job& job) {
  const std::vector<std::string> few = {"cup", "stool", "table"};
  for (const ModelFile& model : shipped_models()) {
    const bool among_few = std::find(few.begin(), few.end(), model.name) != few.end();
    if (!entry.takes(model.name) || (entry.kind.models && quick && !among_few)) continue;
    if (entry.kind.models) job.arguments.push_back(model.path.string());
    job.inputs.push_back(model.path);
  }
}

Job job_of(const Entry& entry, const fs::path& programs, const Settings& settings) {
  Job job{entry.name, programs / entry.name, settings.quick ? entry.quick_options : entry.options, {}};
  if (entry.kind.threads)
    job.arguments.insert(job.arguments.end(), {"--threads", std::to_string(settings.threads)});
  if (entry.kind.paper_data && !settings.paper_data.empty()) add_paper_data(settings.paper_data, job);
  if (entry.kind.needs_benchmark) add_benchmark(settings.benchmark, job);
  if (entry.kind.models || entry.kind.own_choice) add_models(entry, settings.quick, job);
  return job;
}

/// Runs the program with its words in a log; its exit status.
int run(const Job& job, const fs::path& folder) {
  std::vector<std::string> words = {job.program.string(), "-o", folder.string()};
  words.insert(words.end(), job.arguments.begin(), job.arguments.end());
  return run_child({words, folder / (job.name + ".log")}).status;
}

/// Runs the job unless that was done before; whether it did what it was for.
bool settle(const Job& job, const fs::path& folder) {
  const auto tell = [&](const std::string& what) { std::cout << job.name << ": " << what << std::endl; };
  if (const auto status = completed(job, folder)) {
    tell(*status == 0 ? "complete already" : "complete already, and the answer is no");
    return *status == 0;
  }
  clear(job, folder);
  const Stopwatch watch;
  const int status = run(job, folder);
  if (status == 0 || status == 1) record_completed(job, status, folder);
  const std::string seconds = std::to_string(static_cast<int>(watch.seconds() + 0.5)) + " s";
  if (status == 0) tell("done in " + seconds);
  if (status == 1) tell("done in " + seconds + ", and the answer is no");
  if (status > 1)
    tell("FAILED with status " + std::to_string(status) + " after " + seconds + ": " +
         first_line(folder / (job.name + ".log")));
  return status == 0;
}

/// Is it a name of a file that an experiment, or this program for it, writes?
bool is_written(const std::string& name) {
  return std::any_of(entries().begin(), entries().end(), [&name](const Entry& entry) {
    return is_output_of(entry.name, name) || name == entry.name + ".log" || name == entry.name + ".done";
  });
}

void prepare(const Settings& settings) {
  FilePlan plan;
  for (const fs::path& folder : {settings.paper_data, settings.benchmark})
    plan.reads_all("the input", folder);
  for (const ModelFile& model : shipped_models()) plan.reads("the model", model.path);
  plan.fills("--output", settings.output, is_written);
  plan.check();
  std::error_code error;
  fs::create_directories(settings.output, error);
  if (error) throw OutputError(settings.output.string() + " cannot be made: " + error.message());
}

int run_all(const fs::path& programs, const Settings& settings) {
  prepare(settings);
  // Fails now rather than once for every experiment.
  if (!settings.paper_data.empty()) paper_models(settings.paper_data);
  if (!settings.benchmark.empty()) files_below(settings.benchmark / "data", ".off");
  bool good = true;
  for (const Entry& entry : entries()) {
    const bool asked = settings.only.empty() || std::find(settings.only.begin(), settings.only.end(),
                                                          entry.name) != settings.only.end();
    if (!asked) continue;
    if (entry.kind.needs_paper_data && settings.paper_data.empty())
      std::cout << entry.name << ": skipped, it needs --paper-data" << std::endl;
    else if (entry.kind.needs_benchmark && settings.benchmark.empty())
      std::cout << entry.name << ": skipped, it needs --segmentation-benchmark" << std::endl;
    else if (!fs::exists(programs / entry.name))
      std::cout << entry.name << ": skipped, it was not built" << std::endl;
    else
      good = settle(job_of(entry, programs, settings), settings.output) && good;
  }
  return good ? 0 : 1;
}

}  // namespace

int main(int argc, char** argv) {
  CLI::App app{"Runs every experiment into one folder; goes on where a run before it was killed.", "run_all"};
  app.footer("Example: run_all -o results --quick");
  Settings settings;
  std::vector<std::string> names;
  for (const Entry& entry : entries()) names.push_back(entry.name);
  app.add_option("-o,--output", settings.output, "folder for all results, made when missing")->required();
  app.add_option("--paper-data", settings.paper_data, "folder of the authors' data");
  app.add_option("--segmentation-benchmark", settings.benchmark,
                 "folder of the benchmark of Chen, Golovinskiy and Funkhouser (2009)");
  app.add_flag("--quick", settings.quick, "three models and few directions: a trial in about a minute");
  app.add_option("--threads", settings.threads, "threads of each experiment")->check(CLI::Range(1, 1024));
  app.add_option("--only", settings.only, "only these experiments")->check(CLI::IsMember(names));
  try {
    app.parse(argc, argv);
    return run_all(fs::canonical("/proc/self/exe").parent_path(), settings);
  } catch (const CLI::ParseError& error) {
    return app.exit(error) == 0 ? 0 : 2;
  } catch (const InputError& error) {
    std::cerr << "run_all: " << error.what() << "\n";
    return 3;
  } catch (const std::exception& error) {
    std::cerr << "run_all: " << error.what() << "\n";
    return 2;
  }
}
