#include "paper_figures/design_run.h"

#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>

#include <limits>
#include <utility>

#include "paper_figures/shown.h"
#include "stackabilization/core/part_names.h"
#include "stackabilization/improvement/removal.h"

namespace stackabilization::figures {
namespace {

constexpr int max_expansions = 10000;

std::vector<std::string> optional_texts(const Fields& fields, const std::string& key) {
  return fields.has(key) ? fields.texts(key) : std::vector<std::string>{};
}

/// The value of the word at `key`, the first one where there is none.
template <class Value>
Value choice(const Fields& fields, const std::string& key,
             const std::vector<std::pair<std::string, Value>>& values) {
  if (!fields.has(key)) return values.front().second;
  std::string words;
  for (const auto& [word, value] : values) {
    if (fields.text(key) == word) return value;
    words += (words.empty() ? "" : " or ") + word;
  }
  fields.refuse(key, words);
}

void force(AnalysisOptions& analysis, const std::vector<std::string>& parts, PrimitiveKind kind) {
  for (const std::string& part : parts) analysis.kinds[part] = kind;
}

}  // namespace

DesignTask read_design_task(const Fields& fields) {
  DesignTask task;
  task.model = read_model_source(fields.object("model"));
  task.removed = optional_texts(fields, "remove");
  task.kept = optional_texts(fields, "keep");
  task.cuboids = optional_texts(fields, "cuboids");
  task.cylinders = optional_texts(fields, "cylinders");
  task.segmentation = choice<SegmentationMethod>(fields, "segmentation",
                                                 {{"automatic", SegmentationMethod::automatic},
                                                  {"whole", SegmentationMethod::whole},
                                                  {"components", SegmentationMethod::components}});
  task.space.kind = choice<DeformationKind>(fields, "deformation",
                                            {{"controllers", DeformationKind::controllers},
                                             {"surface", DeformationKind::surface},
                                             {"iwires", DeformationKind::iwires}});
  const Eigen::Vector3d direction = fields.vector("direction");
  task.space.direction = Direction(direction);
  task.requirements.measure.boxes =
      choice<BoxModel>(fields, "boxes", {{"oriented", BoxModel::oriented}, {"frame", BoxModel::frame}});
  task.requirements.target = fields.number("target");
  if (task.requirements.target >= 1) fields.refuse("target", "a stackability below 1");
  task.options.preset = choice<ImprovementPreset>(
      fields, "preset", {{"refined", ImprovementPreset::refined}, {"paper", ImprovementPreset::paper}});
  // As published: cross-sections that are moved bend what was straight.
  task.options.search.edits.bends = task.options.preset == ImprovementPreset::paper;
  task.options.search.expansions = fields.whole("expansions", 1, max_expansions);
  task.options.effort = std::numeric_limits<double>::infinity();  // what ends it are the expansions
  return task;
}

StructuredShape structured_shape(const DesignTask& task, const ModelFolder& models) {
  AnalysisOptions analysis;
  analysis.segmentation.method = task.segmentation;
  force(analysis, task.cuboids, PrimitiveKind::cuboid);
  force(analysis, task.cylinders, PrimitiveKind::cylinder);
  StructuredShape structured = analyse_structure(models.read(task.model), analysis);
  if (task.removed.empty()) return structured;
  return without_parts(structured, parts_named(structured.shape, task.removed));
}

DesignRun design_run(const DesignTask& task, const ModelFolder& models) {
  return design_run(structured_shape(task, models), task);
}

DesignRun design_run(StructuredShape rest, const DesignTask& task) {
  Requirements requirements = task.requirements;
  requirements.kept_parts = parts_named(rest.shape, task.kept);
  ImprovementTaskOptions options;
  options.kind = task.space.kind;
  options.directions = {task.space.direction->vector()};
  DesignRun run;
  run.task = std::make_unique<const ImprovementTask>(std::move(rest), std::move(requirements), options);
  run.result = improve(*run.task, task.options);
  return run;
}

std::vector<DesignRun> design_runs(const std::vector<DesignTask>& tasks, const ModelFolder& models) {
  std::vector<StructuredShape> shapes;
  for (const DesignTask& task : tasks) shapes.push_back(structured_shape(task, models));
  std::vector<DesignRun> runs(tasks.size());
  tbb::parallel_for(std::size_t{0}, tasks.size(), [&](std::size_t k) {
    // A thread that waits for part of one task is not to begin another.
    tbb::this_task_arena::isolate([&] { runs[k] = design_run(std::move(shapes[k]), tasks[k]); });
  });
  return runs;
}

const Candidate& DesignRun::best() const {
  if (reached()) return result.solutions.front();
  return result.nearest ? *result.nearest : result.before;
}

ImprovedShape improved_shape(const DesignRun& run) {
  const Direction direction(run.best().direction);
  const StackabilityOptions& measure = run.task->checker().requirements().measure;
  return {measured_shape(run.rest().shape, direction, measure),
          measured_shape(run.best().design.shape, direction, measure)};
}

}  // namespace stackabilization::figures
