// Question: by how much does continuous refinement beat the paper's search, on distortion at equal S?
//
//     refined_against_paper [--boxes oriented|frame] [--expansions N] [--threads N] [-o FOLDER]
//                           MODEL[=S[,S...]]...
//
// MODEL is a mesh, whose structure is found first, or a project file; S are its targets along z, which every
// design keeps, with the height kept. A count of expansions ends each search, so that it finds the same
// again. Without one, the target lies half of the way from S at rest to the largest S that the paper's preset
// meets within the limits when it may go on forever. Each target is given to the paper's preset, and the S
// that this reached, which is more, to the refined one: two rows that compare D at equal S. Where the paper's
// preset does not reach a target, both rows are for that target. Every row is the best solution of its run,
// or what came nearest to one.

#include <charconv>
#include <limits>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include "common/clock.h"
#include "common/experiment.h"
#include "stackabilization/core/direction_text.h"
#include "stackabilization/core/errors.h"
#include "stackabilization/deformation/factory.h"
#include "stackabilization/improvement/improve.h"
#include "stackabilization/improvement/shape_change.h"
#include "stackabilization/io/read.h"
#include "stackabilization/stacking/tolerances.h"
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
  std::int64_t expansions = 12;
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

Run run(const DeformationModel& space, ImprovementPreset preset, double target, const Settings& settings) {
  Requirements requirements;
  requirements.target = target;
  requirements.measure.boxes = settings.boxes;
  ImprovementOptions options;
  options.preset = preset;
  options.effort = std::numeric_limits<double>::infinity();
  options.search.expansions = settings.expansions;
  const double start = now();
  Run result{preset, target, improve(RequirementChecker(space, requirements), options), 0};
  result.seconds = now() - start;
  return result;
}

Table& table_of(Report& report) {
  std::vector<Column> all =
      columns({"model", "input_hash", "target", "direction", "preset"}, ColumnKind::key);
  for (const Column& column : columns({"reached", "S", "D", "D_vol", "D_prox", "D_BB", "D_symm", "E",
                                       "change_rms", "edits", "evaluated"}))
    all.push_back(column);
  all.push_back({"seconds", ColumnKind::clock});
  return report.table("", all);
}

/// Runs of one model, each a row.
class Rows {
 public:
  Rows(const std::string& model, Table& table)
      : space_(deformation_model(structured(model))),
        name_(model.substr(model.rfind('/') + 1)),
        hash_(file_hash(model)),
        table_(table) {}

  const DeformationModel& space() const { return *space_; }

  void add(const Run& run) {
    const Candidate& best = run.best();
    const Distortion& d = best.energy.distortion;
    const double change = shape_change(space_->rest().shape, best.design.shape).root_mean_square;
    table_.add({name_, hash_, run.target, direction_text(best.direction),
                run.preset == ImprovementPreset::paper ? "paper" : "refined", run.reached(),
                best.measured.value, d.total(), d.volume, d.proximity, d.box, d.symmetry, best.energy.value,
                change, static_cast<std::int64_t>(best.design.edits.size()),
                std::int64_t{run.improvement.progress.evaluated}, run.seconds});
  }

 private:
  std::unique_ptr<DeformationModel> space_;
  std::string name_, hash_;
  Table& table_;
};

/// What one measurement says is S another may miss by a rounding.
double safely(double reached) {
  return reached - tolerance::stackability;
}

/// Half of the way to the best that the paper's preset meets.
double target_in_reach(const DeformationModel& space, const Settings& settings) {
  constexpr double out_of_reach = 0.99;
  const Run paper = run(space, ImprovementPreset::paper, out_of_reach, settings);
  return safely((paper.improvement.before.measured.value + paper.best().measured.value) / 2);
}

void compare(const Task& task, const Settings& settings, Table& table) {
  Rows rows(task.model, table);
  std::vector<double> targets = task.targets;
  if (targets.empty()) targets = {target_in_reach(rows.space(), settings)};
  for (const double target : targets) {
    const Run paper = run(rows.space(), ImprovementPreset::paper, target, settings);
    rows.add(paper);
    const double reached = paper.reached() ? safely(paper.best().measured.value) : target;
    rows.add(run(rows.space(), ImprovementPreset::refined, reached, settings));
  }
}

}  // namespace

int main(int argc, char** argv) {
  Experiment experiment(
      "refined_against_paper",
      "By how much does continuous refinement beat the paper's search, on distortion at equal S?",
      Inputs::none);
  Settings settings;
  std::vector<std::string> texts;
  CLI::App& app = experiment.app();
  app.add_option("--boxes", settings.boxes, "how boxes are measured: oriented or frame")
      ->transform(CLI::CheckedTransformer(
          std::map<std::string, BoxModel>{{"oriented", BoxModel::oriented}, {"frame", BoxModel::frame}}));
  app.add_option("--expansions", settings.expansions, "limit of each search")->check(CLI::PositiveNumber);
  app.add_option("tasks", texts, "MODEL[=S[,S...]]: meshes or project files with their targets")->required();
  return experiment.run(argc, argv, [&](Report& report) {
    std::vector<Task> tasks;
    for (const std::string& text : texts) tasks.push_back(task_of(text));
    Table& table = table_of(report);
    for (const Task& task : tasks) try {
        compare(task, settings, table);
      } catch (const InputError& error) {
        report.failed(error.what());
      }
  });
}
