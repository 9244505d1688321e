// Question: by how much does continuous refinement beat the paper's search, on distortion at equal S?
//
//     refined_against_paper [--boxes oriented|frame] [--seconds T] [--expansions N] [--threads N]
//                           [-o FILE.csv] MODEL[=S[,S...]]...
//
// MODEL is a mesh, whose structure is found first, or a project file; S are its targets along z, with the
// height kept. Without one, the target lies half of the way from S at rest to the largest S that the paper's
// preset meets within the limits when it may go on forever. Each target is given to the paper's preset, and
// the S that this reached, which is more, to the refined one: two rows that compare D at equal S. Where the
// paper's preset does not reach a target, both rows are for that target. Every row is the best solution of
// its run, or what came nearest to one.

#include <tbb/global_control.h>
#include <tbb/info.h>

#include <CLI/CLI.hpp>
#include <charconv>
#include <cstdio>
#include <iostream>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include "common/provenance.h"
#include "stackabilization/improvement/improve.h"
#include "stackabilization/improvement/shape_change.h"
#include "stackabilization/shape/errors.h"
#include "stackabilization/shape/read.h"
#include "stackabilization/shape/tolerances.h"
#include "stackabilization/shape/write_file.h"
#include "stackabilization/structure/analysis.h"
#include "stackabilization/structure/project_file.h"

using namespace stackabilization;
using namespace stackabilization::experiments;

namespace {

struct Task {
  std::string model;
  std::vector<double> targets;
};

/// MODEL[=S[,S...]].
Task task_of(const std::string& text) {
  const std::size_t equals = text.rfind('=');
  if (equals == std::string::npos) return {text, {}};
  if (equals == 0)
    throw UsageError("'" + text + "': expected a model and its targets, as in table.obj=0.5,0.8");
  Task task{text.substr(0, equals), {}};
  for (std::size_t from = equals; from != std::string::npos;) {
    const std::size_t to = text.find(',', from + 1);
    const std::string number = text.substr(from + 1, to == std::string::npos ? to : to - from - 1);
    double target = 0;
    const auto [end, error] = std::from_chars(number.data(), number.data() + number.size(), target);
    if (error != std::errc() || end != number.data() + number.size() || !(target < 1))
      throw UsageError("'" + text + "': '" + number + "' is no target, expected a number below 1");
    task.targets.push_back(target);
    from = to;
  }
  return task;
}

StructuredShape structured(const std::string& model) {
  return model.ends_with(project_suffix) ? read_project(model) : analyse_structure(read_shape(model));
}

struct Settings {
  BoxModel boxes = BoxModel::oriented;
  double seconds = 60;
  std::int64_t expansions = 2000;
};

struct Run {
  ImprovementPreset preset = ImprovementPreset::paper;
  double target = 0;
  Improvement improvement;
  double seconds = 0;

  bool reached() const { return !improvement.solutions.empty(); }
  const Candidate& best() const {
    if (reached()) return improvement.solutions.front();
    return improvement.nearest ? *improvement.nearest : improvement.before;
  }
};

Run run(const DesignSpace& space, ImprovementPreset preset, double target, const Settings& settings) {
  Requirements requirements;
  requirements.target = target;
  requirements.measure.boxes = settings.boxes;
  ImprovementOptions options;
  options.preset = preset;
  options.search.seconds = settings.seconds;
  options.search.expansions = settings.expansions;
  const double start = now();
  Run result{preset, target, improve(RequirementChecker(space, requirements), options), 0};
  result.seconds = now() - start;
  return result;
}

std::string row(const DesignSpace& space, const Run& run) {
  const Candidate& best = run.best();
  const Distortion& d = best.energy.distortion;
  const double change = shape_change(space.rest().shape, best.design.shape).root_mean_square;
  char text[512];
  std::snprintf(
      text, sizeof text, "%.17g,%s,%d,%.17g,%.17g,%.17g,%.17g,%.17g,%.17g,%.17g,%.17g,%zu,%lld,%.3f\n",
      run.target, run.preset == ImprovementPreset::paper ? "paper" : "refined", run.reached(),
      best.measured.value, d.total(), d.volume, d.proximity, d.box, d.symmetry, best.energy.value, change,
      best.design.edits.size(), static_cast<long long>(run.improvement.progress.evaluated), run.seconds);
  return text;
}

/// Half of the way to the best that the paper's preset meets.
double target_in_reach(const DesignSpace& space, const Settings& settings) {
  constexpr double out_of_reach = 0.99;
  const Run paper = run(space, ImprovementPreset::paper, out_of_reach, settings);
  return (paper.improvement.before.measured.value + paper.best().measured.value) / 2;
}

std::string rows(const Task& task, const Settings& settings) {
  const std::unique_ptr<DesignSpace> space = design_space(structured(task.model));
  const std::string place = task.model.substr(task.model.rfind('/') + 1) + "," + file_hash(task.model) + ",";
  std::vector<double> targets = task.targets;
  if (targets.empty()) targets = {target_in_reach(*space, settings)};
  std::string text;
  for (const double target : targets) {
    const Run paper = run(*space, ImprovementPreset::paper, target, settings);
    // What one measurement says is S another may miss by a rounding.
    const double reached = paper.best().measured.value - tolerance::stackability;
    text += place + row(*space, paper);
    text += place + row(*space, run(*space, ImprovementPreset::refined, paper.reached() ? reached : target,
                                    settings));
  }
  return text;
}

}  // namespace

int main(int argc, char** argv) {
  CLI::App app{"By how much does continuous refinement beat the paper's search, on distortion at equal S?"};
  int threads = tbb::info::default_concurrency();
  Settings settings;
  std::string output = "-";
  std::vector<std::string> texts;
  app.add_option("--boxes", settings.boxes, "how boxes are measured: oriented or frame")
      ->transform(CLI::CheckedTransformer(
          std::map<std::string, BoxModel>{{"oriented", BoxModel::oriented}, {"frame", BoxModel::frame}}));
  app.add_option("--seconds", settings.seconds, "limit of each search")->check(CLI::PositiveNumber);
  app.add_option("--expansions", settings.expansions, "limit of each search")->check(CLI::PositiveNumber);
  app.add_option("--threads", threads, "threads")->check(CLI::Range(1, 1024));
  app.add_option("-o", output, "CSV file; - is standard output");
  app.add_option("tasks", texts, "MODEL[=S[,S...]]: meshes or project files with their targets")->required();
  CLI11_PARSE(app, argc, argv);
  const tbb::global_control limit(tbb::global_control::max_allowed_parallelism,
                                  static_cast<std::size_t>(threads));
  try {
    std::vector<Task> tasks;
    for (const std::string& text : texts) tasks.push_back(task_of(text));
    std::string csv =
        provenance_lines(
            {"refined_against_paper", std::vector<std::string>(argv + 1, argv + argc), threads}) +
        "model,input_hash,target,preset,reached,S,D,D_vol,D_prox,D_BB,D_symm,E,change_rms,edits,evaluated,"
        "seconds\n";
    for (const Task& task : tasks) csv += rows(task, settings);
    write_file_atomically(output, csv);
    return 0;
  } catch (const InputError& error) {
    std::cerr << "refined_against_paper: " << error.what() << "\n";
    return 3;
  } catch (const Error& error) {
    std::cerr << "refined_against_paper: " << error.what() << "\n";
    return 2;
  }
}
